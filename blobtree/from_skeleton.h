#pragma once

#include "blobtree/ridge_rules.h"
#include "blobtree/tree.h"
#include "lsystem/skeleton.h"

namespace barkridge {

/// What happens where internodes meet.
enum class JunctionKind {
  kRidge,   ///< branches touch by precise contact modelling and raise a bark ridge [GMW04, section 3.4]
  kSmooth,  ///< branches blend by summation [GMW04, section 3.3]
};

/// How a parent hands over to its children.
enum class JointKind {
  kFaded,  ///< fields fade along the axes with weights that sum to one (docs/field.md)
  kPaper,  ///< skeletons are shortened and displaced [GMW04, eqs. 4, 7, 8]
};

/// How far the blending of a junction goes.
enum class BlendingKind {
  kSubtrees,  ///< whole subtrees are joined, as in the papers [GMW04, eqs. 5, 6]
  kConfined,  ///< internodes that meet are joined, and the largest of all these fields counts (docs/field.md)
};

struct TreeOptions {
  JunctionKind junction = JunctionKind::kRidge;
  JointKind joint = JointKind::kFaded;
  BlendingKind blending = BlendingKind::kSubtrees;
  /// Up to this turn faded joints round their corners; past it the axis keeps its radius around a sharp one.
  double round_turn_degrees = 30;
  /// The shape of ridges, but where the skeleton or a rule has another one for a fork.
  ContactShape contact;
  std::vector<RidgeRule> ridge_rules;
  /// Total angle by which every internode that is not collinear with its parent is bent; 0 for straight ones.
  double bend_angle_degrees = 0;
};

/// The BlobTree of a plant: F(A) = F_A + J(F(B_1), .., F(B_m)) for an internode A that carries B_1 .. B_m, J being
/// contact or sum by the junction's kind [GMW04, eqs. 5, 6]. Roots that start at the same point are joined like
/// children of the ground; plants rooted apart are united and do not blend. With confined blending, F is the largest of
/// such fields over groups of internodes: those that meet at a junction, or at several with only short internodes
/// between them. A long internode stands in both of its ends' groups. Cost: linear in internodes, whatever the depth,
/// times the number of rules. Throws `InputError` for contact shapes, turns or bend angles outside their ranges.
BlobTree tree_from_skeleton(const Skeleton& skeleton, const TreeOptions& options = {});

}  // namespace barkridge
