#pragma once
// Which joints of a tree fade, and what takes their place where an axis turns too sharply for that.

#include <vector>

#include "lsystem/skeleton.h"

namespace barkridge {

/// What an internode does at its ends. [docs/field.md, "Sharp joints"]
struct JointPlan {
  bool fades_at_base = false;  ///< else its base is a round cap: a root's, or past a sharp joint
  bool fades_at_tip = false;   ///< else its tip is a round cap
  /// Whether the largest of its field and that of what it carries counts, instead of their sum.
  bool is_united = false;
  double shortening = 0;  ///< of its tip, in scene units; less than its length
};

/// The plans of all internodes. Forks fade. A lone child whose axis turns by more than `kMostFadedTurnDegrees` starts
/// with a round cap, and what carries it is shortened as in the papers [GMW04, eq. 4] or, where it is too short for
/// that, united with it. Cost: linear.
inline constexpr double kMostFadedTurnDegrees = 8;
std::vector<JointPlan> plan_joints(const Skeleton& skeleton, const ChildTable& table);

}  // namespace barkridge
