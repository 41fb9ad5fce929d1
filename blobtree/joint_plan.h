#pragma once
// Which joints of a tree fade, and what takes their place where it turns too sharply for that.

#include <span>
#include <vector>

#include "blobtree/axes.h"
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

/// The plans of all internodes; `arcs` may be empty. The turn of a joint is the angle between the axis of an internode
/// at its tip and the mean direction of its children, weighted by the cross-sections of their bases. An axis that turns
/// by more than `round_turn_degrees` turns sharply, a fork by more than twice as much, unless all of its branches are
/// thin; so does an axis where what meets is too short or too steep to fade. Past a sharp joint internodes start with
/// round caps, and what carries them is shortened as in the papers [GMW04, eq. 4] or, where that would not close the
/// joint without a trace, united with them. Cost: linear.
std::vector<JointPlan> plan_joints(const Skeleton& skeleton, std::span<const Arc> arcs, const ChildTable& table,
                                   double round_turn_degrees);

}  // namespace barkridge
