#pragma once
// How a line meets cones, eight at once, for the instruction set that the machine has.

#include <array>
#include <cstddef>

#include "base/geometry.h"

namespace barkridge {

/// Records of cones side by side, their places relative to a point of the line. In units of the model.
struct alignas(32) ConeColumns {
  static constexpr std::size_t kWidth = 8;
  using Column = std::array<float, kWidth>;

  std::array<Column, 3> base, axis;
  Column base_radius, taper, length;
  Column rise_start, rise_scale, fall_start, fall_scale;
  Column is_plain;  ///< 1 for a plain cone, else 0
  Column
      limited_slope;  ///< where limits of the radius may be at work, a bound of the normalised distance's slope; else 0
  Column is_unknown;  ///< 1 where nothing is known but where the support is
};

/// What a line meets of them: bits and numbers by lane, meaningless for lanes beyond the count, and all but the bits
/// for those that are not met.
struct alignas(32) ConesMet {
  ConeColumns::Column lo, hi;  ///< the part of the line in the support
  ConeColumns::Column highest, slope, least_second, most_second;
  unsigned met = 0, steady = 0;  // last, since columns are aligned
};

/// A part of a line, in units of the model from the point on.
struct LineReach {
  float lo, hi;
};

/// The line's piece reaches by `half` to both sides of the point; lengths along it are in units of the model.
void meet_cones(const ConeColumns& cones, std::size_t count, const Vec3& direction, float half, ConesMet& met);

}  // namespace barkridge
