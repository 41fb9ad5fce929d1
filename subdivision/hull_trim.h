#pragma once
// How far from their meeting point branches become separate.

#include <span>
#include <vector>

#include "base/geometry.h"

namespace barkridge {

/// A branch as it leaves a joint.
struct HullBranch {
  Vec3 direction{0, 1, 0};  ///< unit, away from the joint
  double radius = 1;
  double room = 1;  ///< the length along it that the joint may take, > 0
};

/// A cone about a branch's axis, its apex at the joint: the branch is inside, nothing else is.
struct HullCone {
  double angle = 0;  ///< between axis and side, in [0, kWidestHullCone]
  double gap = 0;    ///< to the nearest other cone's side; infinite for a branch alone
};

/// Radians, 75 degrees: a wider cone would put its ring too near to the joint's centre for a well-shaped hull.
inline constexpr double kWidestHullCone = 1.3089969389957472;

/// Cones that do not overlap. Two cylinders' silhouettes touch where their axes' angle divides as
/// `tan a1 = r1 sin(t) / (r2 + r1 cos(t))` [Mac04, equations 5.1 and 5.2, as angles]; a branch that would get no
/// ring into its room so gets more of the angle where the other, if not thicker, can spare it. No share is more than a
/// right angle. A margin in proportion to the smaller share lies between them. Branches in one direction get cones of
/// angle 0. Quadratic in the number of branches.
std::vector<HullCone> hull_cones(std::span<const HullBranch> branches);

}  // namespace barkridge
