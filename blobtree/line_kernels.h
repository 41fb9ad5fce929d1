#pragma once
// How a line meets cones, eight at once, for the instruction set that the machine has.

#include <array>
#include <cstddef>

namespace barkridge {

/// Records of cones side by side, and for each the piece of a line that meets it; places are relative to the piece's
/// middle. In units of the model.
struct alignas(32) ConeColumns {
  static constexpr std::size_t kWidth = 8;
  using Column = std::array<float, kWidth>;

  std::array<Column, 3> base, axis;
  Column base_radius, taper, length;
  Column rise_start, rise_scale, fall_start, fall_scale;
  Column is_plain;  ///< 1 for a plain cone, else 0
  /// Where limits of the radius may be at work, a bound of the normalised distance's slope; else 0.
  Column limited_slope;
  std::array<Column, 3> direction;
  Column half;   ///< the piece reaches so far to both sides
  Column slack;  ///< what is met stays so near to the piece, point by point: 0 for a line, more for a curve along it
};

/// What the pieces meet: bits and numbers by lane, meaningless for lanes beyond the count, and all but the bits for
/// those that are not met.
struct alignas(32) ConesMet {
  ConeColumns::Column lo, hi;  ///< the part of the piece in the support, or within reach of it
  ConeColumns::Column highest, slope, least_second, most_second;
  unsigned met = 0, steady = 0;  // last, since columns are aligned
};

void meet_cones(const ConeColumns& cones, std::size_t count, ConesMet& met);

}  // namespace barkridge
