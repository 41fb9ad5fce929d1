#include "blobtree/box_hierarchy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <tbb/parallel_sort.h>

#include "blobtree/morton.h"

namespace barkridge {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float rounded_down(double x) {
  const float f = static_cast<float>(x);
  return f <= x ? f : std::nextafter(f, -kInfinity);
}
float rounded_up(double x) {
  const float f = static_cast<float>(x);
  return f >= x ? f : std::nextafter(f, kInfinity);
}

}  // namespace

BoxHierarchy::BoxHierarchy(std::span<const Box> boxes) : numbers_(boxes.size()), places_(boxes.size()) {
  if (boxes.empty()) return;
  Box all;
  for (const Box& box : boxes) all = unite(all, box);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> curve(boxes.size());
  for (std::uint32_t i = 0; i < curve.size(); ++i) curve[i] = {morton_code(boxes[i].center(), all), i};
  tbb::parallel_sort(curve.begin(), curve.end());
  for (std::uint32_t i = 0; i < curve.size(); ++i) {
    numbers_[i] = curve[i].second;
    places_[curve[i].second] = i;
  }
  const auto empty_group = [] {
    Group group;
    for (auto& row : group.lo) row.fill(kInfinity);
    for (auto& row : group.hi) row.fill(-kInfinity);
    return group;
  };
  levels_.emplace_back((boxes.size() + kWidth - 1) / kWidth, empty_group());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    Group& group = levels_[0][i / kWidth];
    const Box& box = boxes[numbers_[i]];
    for (int axis = 0; axis < 3; ++axis) {
      if (box.empty()) continue;
      group.lo[axis][i % kWidth] = rounded_down(box.lo[axis]);
      group.hi[axis][i % kWidth] = rounded_up(box.hi[axis]);
    }
  }
  while (levels_.back().size() > 1) {
    const std::vector<Group>& below = levels_.back();
    std::vector<Group> level((below.size() + kWidth - 1) / kWidth, empty_group());
    for (std::size_t i = 0; i < below.size(); ++i) {
      Group& group = level[i / kWidth];
      for (int axis = 0; axis < 3; ++axis) {
        group.lo[axis][i % kWidth] = *std::min_element(below[i].lo[axis].begin(), below[i].lo[axis].end());
        group.hi[axis][i % kWidth] = *std::max_element(below[i].hi[axis].begin(), below[i].hi[axis].end());
      }
    }
    levels_.push_back(std::move(level));
  }
}

unsigned BoxHierarchy::overlapping(const Group& group, const std::array<float, 3>& lo, const std::array<float, 3>& hi) {
  std::array<std::uint32_t, kWidth> apart{};
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < kWidth; ++k) {
      apart[k] |= static_cast<std::uint32_t>(group.lo[axis][k] > hi[axis]) |
                  static_cast<std::uint32_t>(group.hi[axis][k] < lo[axis]);
    }
  }
  unsigned found = 0;
  for (std::size_t k = 0; k < kWidth; ++k) found |= (1u - apart[k]) << k;
  return found;
}

bool BoxHierarchy::find(const Box& region, std::size_t most, std::vector<std::uint32_t>& found) const {
  if (numbers_.empty() || region.empty()) return true;
  const std::array<float, 3> lo{rounded_down(region.lo.x), rounded_down(region.lo.y), rounded_down(region.lo.z)};
  const std::array<float, 3> hi{rounded_up(region.hi.x), rounded_up(region.hi.y), rounded_up(region.hi.z)};
  const std::size_t start = found.size();
  // On the way down, a level's groups that are still to visit: bit k of `open` is group 8 g + k one level below.
  struct Visit {
    std::size_t group;
    unsigned open;
  };
  std::array<Visit, 24> path;
  std::size_t level = levels_.size() - 1;
  path[level] = {0, overlapping(levels_[level][0], lo, hi)};
  while (true) {
    Visit& here = path[level];
    if (level == 0) {
      for (; here.open != 0; here.open &= here.open - 1) {
        if (found.size() - start == most) return false;
        found.push_back(numbers_[here.group * kWidth + static_cast<std::size_t>(std::countr_zero(here.open))]);
      }
    }
    if (here.open == 0) {
      if (++level < levels_.size()) continue;
      std::sort(found.begin() + static_cast<std::ptrdiff_t>(start), found.end());
      return true;
    }
    const std::size_t child = here.group * kWidth + static_cast<std::size_t>(std::countr_zero(here.open));
    here.open &= here.open - 1;
    --level;
    path[level] = {child, overlapping(levels_[level][child], lo, hi)};
  }
}

std::span<const std::uint32_t> BoxHierarchy::group(std::size_t number) const {
  const std::size_t start = number * kWidth;
  return std::span(numbers_).subspan(start, std::min(kWidth, numbers_.size() - start));
}

Box BoxHierarchy::box(std::size_t number) const {
  const Group& group = levels_[0][places_[number] / kWidth];
  const std::size_t k = places_[number] % kWidth;
  return {{group.lo[0][k], group.lo[1][k], group.lo[2][k]}, {group.hi[0][k], group.hi[1][k], group.hi[2][k]}};
}

std::size_t BoxHierarchy::memory() const {
  std::size_t bytes = (numbers_.capacity() + places_.capacity()) * sizeof(std::uint32_t);
  for (const auto& level : levels_) bytes += level.size() * sizeof(Group);
  return bytes;
}

}  // namespace barkridge
