#pragma once
// A control mesh for any skeleton: branches of any number in any directions meet in convex hulls.

#include <cstddef>

#include "lsystem/skeleton.h"
#include "subdivision/control_mesh.h"

namespace barkridge {

struct HullOptions {
  /// Vertices of a ring around a branch, 3 to 64. Four is the best trade of coarseness against the shrinking of
  /// refinement. [Pie12, section 4.2.2]
  int ring_vertices = 4;
  /// Most rings along an internode; more would be needed only where it is over 3 times as long as thick.
  int max_segments = 64;
  /// Where two joints have little room, rings shrink to this part of their branch's radius, in (0, 1], before the
  /// joints are merged. 1 keeps every branch as thick as it is and merges the most.
  double thinnest_ring = 0.7;
  /// Throws `LimitError` instead of making more than these.
  std::size_t max_triangles = 200'000'000;
};

/// Dresses a skeleton: rings around its internodes, and between the rings of branches that meet the convex hull of the
/// rings' vertices on a sphere about the meeting point. [Pie12, section 4.2; HBC10]
///
/// The result is closed, 2-manifold and oriented, of genus 0 a plant: a plant is what is connected, from base to tip or
/// by a common base of several roots. An internode that begins anywhere but at its parent's tip begins a plant of its
/// own. Ends are flat, with a sharp edge around them, or pointed where the tip is less than a thousandth as thick as
/// the base.
///
/// * A bend of up to 60 degrees between internodes of like radius is one ring; all other meetings are joints.
/// * Trimming: at a joint each branch keeps to a cone about its axis, and cones are apart by construction, whatever the
///   radii, angles and number of branches. Rings lie where branches leave their cones, or nearer and thinner where the
///   internode has no room for that. The joint's surface is seen from its centre once in every direction, so that it
///   cannot meet itself.
/// * Merging: an internode too short for its rings (`thinnest_ring`) gives way: the joint at its tip moves to its base,
///   and a branch that ends inside of its joint goes. Of branches that leave in one direction, or nearly so, the
///   shortest give way first. What is shorter than single precision tells apart is left out, a whole plant too.
///
/// Limbs that cross elsewhere than at their joint cross in the mesh too. Texture coordinates: u runs once around each
/// branch, v along it in units of its circumference, from the root on; triangles of a joint continue one of their
/// branches, with seams to the others. Internodes and ages of vertices are given; a joint's extra vertices belong to
/// the thickest branch. The age of an internode counts from its birth to the youngest's.
///
/// Linear in internodes, and quadratic in the branches of a joint. The same for any number of threads. Throws
/// `InputError` for options out of range, for internodes whose parents do not come before them (a loop), and for places
/// and radii that are not finite or radii not above 0; and `LimitError`.
ControlMesh hull_mesh(const Skeleton& skeleton, const HullOptions& options = {});

}  // namespace barkridge
