#pragma once
// Where branches meet: the plane they lie in, their order around the joint, and the room that they need.

#include <cstdint>
#include <span>
#include <vector>

#include "lsystem/skeleton.h"

namespace barkridge {

/// A branch at a joint; the first of a joint's is the one that carries the others.
struct JointBranch {
  Vec3 direction{0};  ///< of length 1, away from the joint
  double radius = 0;
  InternodeId internode = 0;  ///< for messages
};

/// The unit normal of the plane through the joint to which the branches' directions are nearest, by least squares; of
/// the two the one whose largest component is positive. Throws `InputError` that names the internode where a branch
/// leaves the plane by more than the given angle, 90 to allow all, and where two branches point in the same direction
/// to 1 degree, to which no joint can be built. Cost: quadratic in branches, whose number the second rule bounds.
Vec3 branching_plane(std::span<const JointBranch> branches, double max_out_of_plane_degrees);

/// The branches counter-clockwise around the normal, by the angle of their projections into the plane; the first stays
/// the first.
std::vector<std::uint32_t> around(std::span<const JointBranch> branches, const Vec3& normal);

/// How far from the joint a cylinder must begin so that another, at `angle` to it (0 to pi, not included), begins
/// beside it and not inside it [Mac04, eqs. 5.1, 5.2]: (other + radius cos angle) / sin angle. Where the two walls
/// would meet behind the joint on one of the axes, that one begins in the joint and the other where it clears its end;
/// the equations grow beyond all bounds there, for cylinders of different radii in nearly opposite directions.
double clearance(double radius, double other, double angle);

/// For every branch the largest clearance from any other.
std::vector<double> clearances(std::span<const JointBranch> branches);

}  // namespace barkridge
