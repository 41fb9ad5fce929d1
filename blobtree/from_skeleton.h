#pragma once

#include <optional>
#include <vector>

#include "blobtree/ridge_rules.h"
#include "blobtree/tree.h"
#include "lsystem/selection.h"
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

/// Bends some internodes.
struct BendRule {
  Selection internodes;
  double angle_degrees = 20;  ///< in [0, 180)
};

/// How a branch ends that is neither cut nor shed.
enum class TipKind {
  kRound,    ///< in half a ball
  kPointed,  ///< in a cone down to kPointRadius
  kBud,      ///< in a cone that widens to kBudRadius and one down to kPointRadius
};
/// In radii of the internode's tip.
inline constexpr double kPointRadius = 1.0 / 16;
inline constexpr double kBudRadius = 1.3;
inline constexpr double kBudWidest = 0.4;  ///< share of a bud's length at which it is widest
inline constexpr double kShortestTip = 3;

/// Ends some branches.
struct TipRule {
  Selection internodes;  ///< by the last ones of branches
  TipKind kind = TipKind::kPointed;
  double length = 5;  ///< from the internode's tip, in radii there; at least kShortestTip
};

/// Moves the surface of thick branches in and out, as furrowed bark does. Twigs are too young for that: the amount
/// falls to nothing from 1.6 to 0.55 of `furrowed_radius`, by an internode's mean radius. [docs/field.md,
/// "Displacement"]
struct DisplacementOptions {
  double amount = 0;  ///< that of Displacement, in [0, 0.5), so that no axis is laid open; 0 for none
  /// Those of SolidNoise. Without a wavelength it is kFurrowWidth of the thickest branch's radius.
  std::optional<double> wavelength;
  double stretch = 5;
  int octaves = 3;
  bool ridged = true;
  int seed = 0;
  /// Radius of branches of which half the amount is left, or so; without it half the thickest branch's.
  std::optional<double> furrowed_radius;
};
inline constexpr double kFurrowWidth = 0.4;

struct TreeOptions {
  JunctionKind junction = JunctionKind::kRidge;
  JointKind joint = JointKind::kFaded;
  BlendingKind blending = BlendingKind::kSubtrees;
  /// Up to this turn, twice as much at forks, faded joints round their corners; past it the axis keeps its radius
  /// around a sharp one.
  double round_turn_degrees = 30;
  /// The shape of ridges, but where the skeleton or a rule has another one for a fork.
  ContactShape contact;
  std::vector<RidgeRule> ridge_rules;
  /// Total angle by which every internode that is not collinear with its parent is bent; 0 for straight ones. [GMW04,
  /// section 3.6] Where a bent internode alone continues another, both are bent to a common tangent instead, whatever
  /// their angles. [docs/field.md, "Bend"]
  double bend_angle_degrees = 0;
  /// Of several rules for an internode the last one counts; without one the angle above, or a round tip.
  std::vector<BendRule> bends;
  std::vector<TipRule> tips;
  /// Of the internodes' own fields: contacts join displaced branches, and what is cut off stays plane.
  DisplacementOptions displacement;
};

/// The BlobTree of a plant: F(A) = F_A + J(F(B_1), .., F(B_m)) for an internode A that carries B_1 .. B_m, J being
/// contact or sum by the junction's kind [GMW04, eqs. 5, 6]. Roots that start at the same point are joined like
/// children of the ground; plants rooted apart are united and do not blend. Cut ends get their faces and scars their
/// hollows. [docs/field.md, "Missing organs"] With confined blending, F is the largest of such fields over groups of
/// internodes: those that meet at a junction, or at several that influence the same part of an internode between them.
/// Any other internode stands in both of its ends' groups. [docs/field.md, "Confined blending"] Cost: linear in
/// internodes, whatever the depth, times the number of rules; for the groups as `ends_of_blending`.
/// Throws `InputError` for numbers outside their ranges and for cut ends and scars of internodes that have children.
BlobTree tree_from_skeleton(const Skeleton& skeleton, const TreeOptions& options = {});

/// The tree, which of its nodes is each internode's primitive, and the skeleton that these internodes are of: with
/// those that curved axes and tips add.
struct PlantTree {
  BlobTree tree;
  std::vector<NodeId> primitives;  ///< by internode; kNoNode for what is shed
  Skeleton skeleton;
};
PlantTree plant_from_skeleton(Skeleton skeleton, const TreeOptions& options = {});

}  // namespace barkridge
