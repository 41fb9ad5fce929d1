#pragma once
// Where lattice edges cross the surface.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.h"
#include "blobtree/field.h"

namespace barkridge {

/// A piece of a line along an axis with one end inside the solid and one outside.
struct EdgeCrossing {
  struct End {
    double coordinate = 0;  ///< along the axis
    double value = 0;       ///< the field minus the iso-value: inside where it is not negative
    double weight = 1;      ///< of the value in the next interpolation
  };

  Vec3 point{0};  ///< on the line; its coordinate along `axis` is where the root is put
  int axis = 0;
  double least = 0;  ///< the root's coordinate is kept between these two
  double most = 0;
  std::array<End, 2> ends;  ///< the lower one first; they close in on the root
  int last_moved = -1;      ///< which end moved last, if any
  bool halves_next = false;
};

/// Memory that `find_roots` uses again from call to call.
struct RootScratch {
  std::vector<std::uint32_t> active;
  std::vector<Vec3> points;
  std::vector<double> values;
};

/// Puts every crossing's point where the solid ends along its line, to `tolerance` in position unless the field is flat
/// there. All crossings advance together, one batch of field evaluations a round: two to four rounds for smooth fields;
/// for any other, even one that jumps, the bracket between the ends halves at least every other round after the first
/// eight. Roots do not depend on the batch.
void find_roots(const Field& field, double tolerance, std::span<EdgeCrossing> crossings, RootScratch& scratch);

}  // namespace barkridge
