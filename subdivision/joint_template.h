#pragma once
// The triangles of a joint between hexagonal cross-sections, put together from templates [Mac04, section 5.5.3].

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "base/geometry.h"

namespace barkridge {

/// The cross-section with which a branch ends at a joint. Its corners are numbered as seen by one who looks from the
/// branch into the joint with the plane's normal, "the front", upward: vertex-forward from the corner at the front,
/// edge-forward from the one after the edge at the front, each time towards the next branch around the joint.
struct JointRing {
  std::array<std::uint32_t, 6> vertices{};
  bool edge_forward = false;
};

/// Appends the triangles that close the gap between rings that stand counter-clockwise around the plane's normal, the
/// carrying branch's first; three or more. Together with the walls of the branches they are a closed surface, whatever
/// the places of the vertices, which decide no more than diagonals.
///
/// Every part is a template that the orientations of its rings choose, vertex-forward (0) or edge-forward (1):
///   - right, top, left: the strip between neighbours, from half a ring to half a ring; right from the carrying
///     branch to the first, left from the last to the carrying one, top between two that are carried. 4 each.
///   - bottom: the triangles at the front between the carrying branch and two neighbours that it carries, and their
///     mirror image at the back. 8 at the centre, where all three rings give their corner or edge; 4 to the right of it
///     and their mirror images to the left, by the two carried rings, where one corner of the carrying branch serves
///     and only the outer branch still has an edge to give.
/// The collar of a thin branch [Mac04, figure 5.22] is a ring like any other: its 8 left and 8 right templates, by the
/// orientations of carrying branch, thin branch and neighbour, are a top, a bottom and a left or right as above, and
/// the wall from the collar to the branch. Cost: linear.
void triangulate_joint(std::span<const JointRing> rings, const std::vector<glm::vec3>& positions, const Vec3& normal,
                       std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace barkridge
