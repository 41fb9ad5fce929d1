#pragma once
// Branches that are cut, torn or shed: what is left of a skeleton.

#include <span>

#include "lsystem/selection.h"

namespace barkridge {

/// Cuts branches. A branch is a first internode, one whose order its parent does not have, and those of the same order
/// that continue it. Where `branches.ids` are given the cut is in those internodes themselves, wherever they stand.
struct CutRule {
  Selection branches;     ///< by their first internodes
  double position = 0.5;  ///< share of the branch's length, or of the internode's, that stays: in (0, 1)
  /// Angle between the cut's normal and the axis: away from the direction of the branch's carrier, or towards it if
  /// negative. At most kSteepestCutDegrees.
  double tilt_degrees = 0;
  double splinters = 0;  ///< as in CutEnd: a clean cut, or a torn break of this height
};

/// Sheds branches, roots excepted; or those that begin with one of `branches.ids`, whatever their orders.
struct ScarRule {
  Selection branches;  ///< by their first internodes
  ScarShape shape;
};

/// The skeleton without what the rules take away and without the descendants of its cut ends and scars. What a cut
/// leaves of an internode keeps its taper; of a shed branch a piece is left that stands for its stub. Of several cuts
/// through an internode the first one counts, and a scar counts before cuts. Organs go with what they grew on.
/// Internodes keep their `identity`. Cost: linear. Throws `InputError` for numbers outside the ranges stated above.
Skeleton prune(Skeleton skeleton, std::span<const CutRule> cuts, std::span<const ScarRule> scars);

/// Gives what growth has shed (`Skeleton::shed_branches`) scars that heal: depth and stub of `shape` shrink evenly to
/// nothing over `healing_steps` derivation steps. Each needs an internode that stands for its stub, which is added at
/// the end. What was shed so long ago, or what carried it is not there any more, leaves none. Cost: linear. Throws
/// `InputError` for a shape outside its ranges.
Skeleton with_scars_of_shed(Skeleton skeleton, double healing_steps, const ScarShape& shape = {});

/// `axis` tilted by an angle away from `carrier`, or towards it by a negative one; both of length 1. Where they are
/// parallel, in some direction that only they decide.
Vec3 tilted_away(const Vec3& axis, const Vec3& carrier, double degrees);

/// How much of a shed branch stands for its stub: as long as the radii of carrier and branch together, if it was as
/// long.
double stub_length(double carrier_radius, double radius);

}  // namespace barkridge
