#pragma once
// Creases narrower than the lattice can resolve.

#include <glm/vec3.hpp>
#include <vector>

#include "blobtree/field.h"
#include "polygonize/inside_rows.h"
#include "polygonize/lattice.h"

namespace barkridge {

/// How many cells beyond a block the closing looks.
inline constexpr int kCreaseHalo = 1;
inline constexpr int kHaloPoints = kBlockPoints + 2 * kCreaseHalo;

/// Where two parts of a solid touch, the outside ends in a wedge whose walls become tangent. Near its bottom it is
/// narrower than any cell, and lattice points that happen to fall into it would make hollows and tunnels that the
/// surface does not have. So an outside point counts as inside when its neighbours on both sides along an axis are
/// inside and hang together by inside points around it: by steps from face to face within its 18 neighbours, as in the
/// test for simple points [BM94]. Then it lies in a slit that ends there, and not in a gap between two branches that
/// pass each other.
///
/// `values` are samples of a block with its halo, kHaloPoints along each axis, x fastest. Returns those of the block's
/// own points that change sides, counted from its first. A point's verdict depends on its neighbours only, so blocks
/// agree.
std::vector<glm::ivec3> crease_bottoms(const std::vector<double>& values);

/// Whether `crease_bottoms` can find any, from the signs of a block's own samples and the few of its halo that they
/// make necessary: whether some outside point has inside neighbours on both sides along an axis. `first` is the block's
/// first point; `points` and `halo_values` are memory to use.
bool may_have_crease_bottoms(const Lattice& lattice, const Field& with_halo, const glm::ivec3& first,
                             const InsideRows& inside, std::vector<Vec3>& points, std::vector<double>& halo_values);

}  // namespace barkridge
