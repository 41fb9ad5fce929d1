#pragma once
// The surface between the rings of branches that meet.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.h"

namespace barkridge {

/// The end of a branch, seen from the joint's centre: a ring on the unit sphere, and how far away it is.
struct HullRing {
  Vec3 axis{0, 1, 0};     ///< unit, the cap's middle
  Vec3 side{1, 0, 0};     ///< unit, towards the first vertex, square to the axis
  Vec3 forward{0, 0, 1};  ///< unit, towards the vertex at a quarter, square to both
  double angle = 0;       ///< from the axis to the vertices, in (0, pi / 2)
  double gap = 0;         ///< to the nearest other ring's circle, > 0
  double distance = 1;    ///< from the centre to the ring's middle, > 0
};

/// How many times farther from the axes than the branches are thick a joint's surface may be.
inline constexpr double kJointReach = 1.25;

/// The direction of a ring's vertex `j` of `count`.
Vec3 ring_direction(const HullRing& ring, int j, int count);

/// What closes the sphere outside of all rings. Vertex `j` of ring `i` has number `i * ring_vertices + j`; the numbers
/// after the last ring's are those of the extra vertices.
struct HullJoint {
  /// From the centre: where rings leave more than half a sphere's width free, and where triangles would be sails
  /// between branches that leave the joint at very different distances.
  std::vector<Vec3> extra;
  /// Counter-clockwise from outside. Whatever positive lengths the vertices' directions get, triangles meet only in
  /// what they share.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Triangulates the sphere outside of at least two rings by the convex hull of their vertices, of which every ring is a
/// face, and leaves these faces out. The middles of edges are within `kJointReach`, but for a few between branches of
/// nearly one direction; extra vertices lie on the branches, taken as cylinders that are round about the centre.
/// Throws `InputError` where rings are too narrow, or too close to each other, for double precision.
HullJoint hull_joint(std::span<const HullRing> rings, int ring_vertices);

}  // namespace barkridge
