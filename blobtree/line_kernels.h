#pragma once
// How lines meet cones, sixteen at once, for the instruction set that the machine has.

#include <array>
#include <cstddef>

namespace barkridge {

/// Records of cones side by side, relative to an origin. In units of the model.
struct alignas(64) ConeColumns {
  static constexpr std::size_t kWidth = 16;
  using Column = std::array<float, kWidth>;

  std::array<Column, 3> base, axis;
  Column base_radius, taper, length;
  Column rise_start, rise_scale, fall_start, fall_scale;
  Column is_plain;  ///< 1 for a plain cone, else 0
  /// Where limits of the radius may be at work, a bound of the normalised distance's slope; else 0.
  Column limited_slope;
};

/// Pieces of lines side by side, relative to the same origin, which is near to them: none is farther from it than a few
/// times the size of what they meet.
struct alignas(64) LineColumns {
  std::array<ConeColumns::Column, 3> middle, direction;
  ConeColumns::Column half;  ///< the piece reaches so far to both sides
  ConeColumns::Column
      slack;  ///< what is met stays so near to the piece, point by point: 0 for a line, more for a curve
};

/// What the pieces meet: bits and numbers by lane, meaningless for lanes beyond the count, and all but the bits for
/// those that are not met.
struct alignas(64) ConesMet {
  /// The part of the piece in the support, or within reach of it: from -1 at its start to 1 at its end.
  ConeColumns::Column lo, hi;
  ConeColumns::Column highest, slope, least_second, most_second;
  unsigned met = 0, steady = 0;  // last, since columns are aligned
};

/// The first `count` lines, each with the cone beside it.
void meet_cones(const ConeColumns& cones, const LineColumns& lines, std::size_t count, ConesMet& met);
/// All of them with the first cone.
void meet_first_cone(const ConeColumns& cones, const LineColumns& lines, std::size_t count, ConesMet& met);

}  // namespace barkridge
