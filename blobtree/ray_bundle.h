#pragma once
// Rays that are searched together, since they lie near each other and meet the same things.

#include <array>
#include <bit>
#include <cstddef>

#include "base/geometry.h"
#include "blobtree/cylinder.h"

namespace barkridge {

/// Some rays of a bundle: bit i stands for the i-th.
using RayLanes = unsigned;

/// Calls `visit(i)` for each of them in turn.
template <typename Visit>
void for_each_lane(RayLanes lanes, const Visit& visit) {
  for (; lanes != 0; lanes &= lanes - 1) visit(static_cast<std::size_t>(std::countr_zero(lanes)));
}

/// A part of every ray of a bundle.
struct alignas(64) RayRanges {
  static constexpr std::size_t kWidth = 16;
  using Column = std::array<double, kWidth>;

  Column lo{}, hi{};

  Interval operator[](std::size_t lane) const { return {lo[lane], hi[lane]}; }
  void set(std::size_t lane, const Interval& range) {
    lo[lane] = range.lo;
    hi[lane] = range.hi;
  }
};

/// Up to `kWidth` rays, and the part of each that matters.
struct alignas(64) RayBundle {
  static constexpr std::size_t kWidth = RayRanges::kWidth;
  using Column = RayRanges::Column;

  std::array<Column, 3> origin{}, direction{};
  RayRanges ranges;
  std::size_t count = 0;

  RayBundle() = default;
  /// Of one ray.
  RayBundle(const Ray& ray, const Interval& range) { add(ray, range); }

  void add(const Ray& ray, const Interval& range) {
    for (int k = 0; k < 3; ++k) {
      origin[static_cast<std::size_t>(k)][count] = ray.origin[k];
      direction[static_cast<std::size_t>(k)][count] = ray.direction[k];
    }
    ranges.set(count++, range);
  }
  Ray ray(std::size_t lane) const {
    return {{origin[0][lane], origin[1][lane], origin[2][lane]},
            {direction[0][lane], direction[1][lane], direction[2][lane]}};
  }
  RayLanes lanes() const { return (RayLanes{1} << count) - 1; }
};

/// The parts of some of a bundle's ranges in which the rays are in a cylinder, or a little more; returns those that
/// have one.
RayLanes clip(const RayBundle& rays, RayLanes lanes, const Cylinder& cylinder, RayRanges& parts);

}  // namespace barkridge
