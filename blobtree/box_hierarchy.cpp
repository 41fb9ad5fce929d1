#include "blobtree/box_hierarchy.h"

#include <algorithm>
#include <bit>
#include <cmath>

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

BoxHierarchy::BoxHierarchy(std::span<const Box> boxes) : size_(boxes.size()) {
  if (boxes.empty()) return;
  const auto empty_group = [] {
    Group group;
    for (auto& row : group.lo) row.fill(kInfinity);
    for (auto& row : group.hi) row.fill(-kInfinity);
    return group;
  };
  levels_.emplace_back((size_ + kWidth - 1) / kWidth, empty_group());
  for (std::size_t i = 0; i < size_; ++i) {
    Group& group = levels_[0][i / kWidth];
    for (int axis = 0; axis < 3; ++axis) {
      if (boxes[i].empty()) continue;
      group.lo[axis][i % kWidth] = rounded_down(boxes[i].lo[axis]);
      group.hi[axis][i % kWidth] = rounded_up(boxes[i].hi[axis]);
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
  if (size_ == 0 || region.empty()) return true;
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
        found.push_back(static_cast<std::uint32_t>(here.group * kWidth) +
                        static_cast<std::uint32_t>(std::countr_zero(here.open)));
      }
    }
    if (here.open == 0) {
      if (++level == levels_.size()) return true;
      continue;
    }
    const std::size_t child = here.group * kWidth + static_cast<std::size_t>(std::countr_zero(here.open));
    here.open &= here.open - 1;
    --level;
    path[level] = {child, overlapping(levels_[level][child], lo, hi)};
  }
}

Box BoxHierarchy::box(std::size_t number) const {
  const Group& group = levels_[0][number / kWidth];
  const std::size_t k = number % kWidth;
  return {{group.lo[0][k], group.lo[1][k], group.lo[2][k]}, {group.hi[0][k], group.hi[1][k], group.hi[2][k]}};
}

std::size_t BoxHierarchy::memory() const {
  std::size_t bytes = 0;
  for (const auto& level : levels_) bytes += level.size() * sizeof(Group);
  return bytes;
}

}  // namespace barkridge
