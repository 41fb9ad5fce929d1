#include "blobtree/joint_plan.h"

#include <cmath>
#include <numbers>

#include "base/large_room.h"

namespace barkridge {

namespace {

// [GMW04, eq. 4], in base radii of the child.
constexpr double kShortening = 1.75;

class Planner {
 public:
  Planner(const Skeleton& skeleton, const ChildTable& table) : internodes_(skeleton.internodes), table_(table) {
    resize_large(plans_, internodes_.size());
  }

  std::vector<JointPlan> run() {
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      plans_[i].fades_at_base = internodes_[i].parent != kNoInternode && !(is_alone(i) && turns_sharply(i));
      plans_[i].fades_at_tip = child_count(i) > 0;
    }
    // Children before parents: a joint that cannot be faded may leave its internode too short to fade at its base.
    for (std::size_t i = internodes_.size(); i-- > 0;) {
      if (has_sharp_tip(i)) plans_[i].fades_at_tip = false;
      const bool may_be_sharp = plans_[i].fades_at_base && (is_alone(i) || is_thin_lateral(i));
      if (may_be_sharp && !plans_[i].fades_at_tip && child_count(i) > 0 && length(i) < fade_end(i)) {
        plans_[i].fades_at_base = false;
      }
    }
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      if (has_sharp_tip(i)) end_sharply(i);
    }
    return std::move(plans_);
  }

 private:
  std::size_t child_count(std::size_t i) const { return table_.first[i + 1] - table_.first[i]; }
  std::size_t first_child(std::size_t i) const { return static_cast<std::size_t>(table_.children[table_.first[i]]); }
  const Internode& parent_of(std::size_t i) const {
    return internodes_[static_cast<std::size_t>(internodes_[i].parent)];
  }
  double length(std::size_t i) const { return glm::distance(internodes_[i].base, internodes_[i].tip); }

  // Whether it is its parent's only child.
  bool is_alone(std::size_t i) const {
    const InternodeId parent = internodes_[i].parent;
    return parent != kNoInternode && child_count(static_cast<std::size_t>(parent)) == 1;
  }

  // Whether a round cap at its base, on its parent's axis, does not reach through the parent's bark on the far side.
  bool is_thin_lateral(std::size_t i) const {
    return !is_alone(i) && 3 * internodes_[i].base_radius < 2 * parent_of(i).tip_radius;
  }

  bool turns_sharply(std::size_t i) const {
    const Vec3 before = parent_of(i).tip - parent_of(i).base, after = internodes_[i].tip - internodes_[i].base;
    const double most = std::cos(kMostFadedTurnDegrees * std::numbers::pi / 180);
    return glm::dot(before, after) < most * glm::length(before) * glm::length(after);
  }

  bool has_sharp_tip(std::size_t i) const { return child_count(i) == 1 && !plans_[first_child(i)].fades_at_base; }

  // Where an internode that fades in has done so.
  double fade_end(std::size_t i) const { return parent_of(i).tip_radius + internodes_[i].base_radius; }

  void end_sharply(std::size_t i) {
    const double shortening = kShortening * internodes_[first_child(i)].base_radius;
    const double least = plans_[i].fades_at_base ? fade_end(i) : 0.0;
    if (length(i) - shortening > least) {
      plans_[i].shortening = shortening;
    } else {
      plans_[i].is_united = true;
    }
  }

  const std::vector<Internode>& internodes_;
  const ChildTable& table_;
  std::vector<JointPlan> plans_;
};

}  // namespace

std::vector<JointPlan> plan_joints(const Skeleton& skeleton, const ChildTable& table) {
  return Planner(skeleton, table).run();
}

}  // namespace barkridge
