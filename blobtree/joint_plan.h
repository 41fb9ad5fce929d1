#pragma once
// Which joints of a tree fade, and what takes their place where it turns too sharply for that.

#include <vector>

#include "lsystem/skeleton.h"

namespace barkridge {

/// What an internode does at its ends. [docs/field.md, "Sharp joints"]
struct JointPlan {
  bool fades_at_base = false;  ///< else its base is a round cap: a root's, or past a sharp joint
  bool fades_at_tip = false;   ///< else its tip is a round cap
  /// Whether the larger of its field and that of what it carries counts, instead of their sum.
  bool is_united = false;
  double shortening = 0;  ///< of its tip, in scene units; less than its length
};

/// The plans of all internodes. The turn of a joint is the angle between an internode's axis and the mean direction of
/// its children, weighted by the cross-sections of their bases. Past `round_turn_degrees` a joint is sharp, unless all
/// of several children are thin: they start with round caps, and what carries them is shortened as in the papers
/// [GMW04, eq. 4] or, where it is too short for that, united with them. Cost: linear.
std::vector<JointPlan> plan_joints(const Skeleton& skeleton, const ChildTable& table, double round_turn_degrees);

}  // namespace barkridge
