#include "blobtree/box_hierarchy.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/large_room.h"
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

struct Bounds {
  std::array<float, 3> lo, hi;
};
constexpr Bounds kNothing{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

}  // namespace

BoxHierarchy::BoxHierarchy(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  numbers_ = order_along_curve(boxes.size(), [&](std::size_t i) { return boxes[i]; });
  resize_large(places_, boxes.size());
  for (std::uint32_t i = 0; i < numbers_.size(); ++i) places_[numbers_[i]] = i;
  levels_.push_back(level_over(boxes.size(), [&](std::size_t i) {
    const Box& box = boxes[numbers_[i]];
    Bounds bounds = kNothing;
    for (int axis = 0; axis < 3 && !box.empty(); ++axis) {
      bounds.lo[axis] = rounded_down(box.lo[axis]);
      bounds.hi[axis] = rounded_up(box.hi[axis]);
    }
    return bounds;
  }));
  while (levels_.back().size() > 1) {
    const std::vector<Group>& below = levels_.back();
    levels_.push_back(level_over(below.size(), [&](std::size_t i) {
      Bounds bounds;
      for (int axis = 0; axis < 3; ++axis) {
        bounds.lo[axis] = *std::min_element(below[i].lo[axis].begin(), below[i].lo[axis].end());
        bounds.hi[axis] = *std::max_element(below[i].hi[axis].begin(), below[i].hi[axis].end());
      }
      return bounds;
    }));
  }
}

template <typename BoundsOf>
std::vector<BoxHierarchy::Group> BoxHierarchy::level_over(std::size_t count, const BoundsOf& bounds_of) {
  std::vector<Group> level;
  resize_large(level, (count + kWidth - 1) / kWidth);
  constexpr std::size_t kTogether = 256;
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, level.size(), kTogether), [&](const Range& range) {
    for (std::size_t i = range.begin() * kWidth; i < range.end() * kWidth; ++i) {
      const Bounds bounds = i < count ? bounds_of(i) : kNothing;
      for (int axis = 0; axis < 3; ++axis) {
        level[i / kWidth].lo[axis][i % kWidth] = bounds.lo[axis];
        level[i / kWidth].hi[axis][i % kWidth] = bounds.hi[axis];
      }
    }
  });
  return level;
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
