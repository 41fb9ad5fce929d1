#pragma once
// An order of places or boxes along a space-filling curve.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/geometry.h"
#include "base/large_room.h"

namespace barkridge {

/// Interleaves the bits of a place in a box, so that places next to each other in order are near each other in space.
/// [Morton 1966]
inline std::uint64_t morton_code(const Vec3& p, const Box& box) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = box.hi[axis] - box.lo[axis];
    const double t = extent > 0 ? (p[axis] - box.lo[axis]) / extent : 0;
    auto place = static_cast<std::uint64_t>(std::clamp(t, 0.0, 1.0) * 0x1FFFFF);
    // Two zeros in front of every bit.
    place = (place | place << 32) & 0x1f00000000ffffull;
    place = (place | place << 16) & 0x1f0000ff0000ffull;
    place = (place | place << 8) & 0x100f00f00f00f00full;
    place = (place | place << 4) & 0x10c30c30c30c30c3ull;
    place = (place | place << 2) & 0x1249249249249249ull;
    code |= place << axis;
  }
  return code;
}

/// The numbers below `count` of boxes that `box_of(number)` gives, in the order of their centres along the curve
/// through the box around them all; of equals, the lower number first.
template <typename BoxOf>
std::vector<std::uint32_t> order_along_curve(std::size_t count, const BoxOf& box_of) {
  using Range = tbb::blocked_range<std::size_t>;
  constexpr std::size_t kTogether = 4096;
  const Range all(0, count, kTogether);
  const Box around = tbb::parallel_reduce(
      all, Box(),
      [&](const Range& range, Box box) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) box = unite(box, box_of(i));
        return box;
      },
      [](const Box& a, const Box& b) { return unite(a, b); });
  std::vector<std::pair<std::uint64_t, std::uint32_t>> curve;
  resize_large(curve, count);
  tbb::parallel_for(all, [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      curve[i] = {morton_code(box_of(i).center(), around), static_cast<std::uint32_t>(i)};
    }
  });
  tbb::parallel_sort(curve.begin(), curve.end());
  std::vector<std::uint32_t> order;
  resize_large(order, count);
  for (std::size_t i = 0; i < count; ++i) order[i] = curve[i].second;
  return order;
}

}  // namespace barkridge
