#pragma once
// A vertex with its neighbours, and Loop's rules for it: what a step makes of it, and where it ends.
//
// A ring is refined without its surroundings, because the vertices next to a vertex after a step depend on no others.
// So rules, limits and tangents of any vertex are studied on its ring alone.

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace barkridge {

/// `Value` is `glm::dvec3` for positions, `glm::dvec2` for texture coordinates.
template <class Value>
struct VertexRing {
  Value center{0};
  std::vector<Value> neighbours;  ///< against the clock; of a vertex on a boundary from one boundary edge to the other
  std::vector<double> sharpness;  ///< of the edges to them, >= 0; infinite on a boundary
  double center_sharpness = 0;
  bool closed = true;  ///< whether the first neighbour follows the last

  void clear() {
    neighbours.clear();
    sharpness.clear();
  }
};

/// Loop's weight of each of `valence` neighbours in a smooth vertex: `(5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n`
/// [Loop87]. The vertex itself has the rest. Valence >= 2.
double neighbour_weight(std::size_t valence);

/// The vertex after a step: a corner (sharp, or of more than two sharp edges) stays, a crease (two sharp edges) becomes
/// 3/4 of itself and 1/8 of its neighbours along the crease, a smooth vertex or dart (one sharp edge) is averaged with
/// `neighbour_weight`s [HDD94]. Where sharpness runs out in this step, the rules before and after are blended by the
/// mean of what runs out [DKT98].
template <class Value>
Value refined_center(const VertexRing<Value>& ring);

/// The whole ring after a step; every sharpness is less by 1.
template <class Value>
VertexRing<Value> refined(VertexRing<Value> ring);

/// Where the vertex goes as steps are repeated for ever. Semi-sharp rings are first refined until no finite sharpness
/// is left, and darts, for which there is no closed mask, until they have converged: exact to 1e-9 of the ring's size
/// in both cases. Finite sharpnesses above 32 count as infinite.
template <class Value>
Value limit_position(const VertexRing<Value>& ring);

/// The surface's unit normal at the limit of the vertex. At creases it is the mean of both sides' normals, at corners
/// that of the triangles', weighted by area; where that vanishes too, (0, 1, 0). On a boundary or beside a crease where
/// seven or more triangles meet the surface has no tangent plane; the normal is that of the tangents along and across.
glm::dvec3 limit_normal(const VertexRing<glm::dvec3>& ring);

}  // namespace barkridge
