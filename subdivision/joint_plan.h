#pragma once
// How much of every branch its joints take.

#include <vector>

#include "subdivision/branches.h"

namespace barkridge {

/// How planar joints are laid out.
struct JointOptions {
  /// A branch at most this many times as thick as a neighbour around its joint gets an asymmetric template: a collar of
  /// vertices around its base, which keeps the blend small and the neighbour round. From 0, none, to less than 1.
  double thin_ratio = 1.0 / 3;
  /// Room between joint and cross-section on top of equations 5.1 and 5.2, in radii of the branch; > 0.
  double gap = 0.25;
  /// How far the branches at a joint may leave their common plane, 0 to 90. Within it they are sorted by their
  /// projections into the plane and keep their directions; 90 accepts every joint.
  double max_out_of_plane_degrees = 30;
};

/// The radius of a thin branch's collar in radii of the branch.
inline constexpr double kCollarRadius = 1.5;

/// What is cut off a branch, as lengths along its axis.
struct Cut {
  double base = 0;    ///< from the joint to the cross-section that closes it
  double collar = 0;  ///< from there to the branch's own first cross-section, where the first is a collar; else 0
  double tip = 0;     ///< before the joint at the branch's tip
  Vec3 normal{0};     ///< of the plane of that joint, if there is one
};

/// The cuts of all branches [Mac04, eqs. 5.1, 5.2]; sorts every branch's children counter-clockwise around the normal
/// of their joint, from the branch itself on. Radii count `radius_scale` times. A curved branch's direction at a
/// joint is that to the point of its axis two radii of the joint's thickest branch away. A branch too short for what
/// its joints need at both ends keeps a fifth of its length, and they share the rest in proportion.
///
/// Throws `InputError` for options out of range and for what `branching_plane` refuses. Cost: linear in internodes,
/// quadratic in the branches of one joint.
std::vector<Cut> plan_joints(Branches& branches, const JointOptions& options, double radius_scale);

}  // namespace barkridge
