#include "blobtree/joint_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/large_room.h"

namespace barkridge {

namespace {

// [GMW04, eq. 4], in base radii of the thickest child.
constexpr double kShortening = 1.75;

// Thinner branches that fade leave their carrier's tip round enough, whatever their turn; in tip radii of the carrier.
constexpr double kLeaderRadius = 0.8;

// What is left of a shortened internode between two round caps, in its base radii: less would bulge.
constexpr double kLeastShortened = 2;

class Planner {
 public:
  Planner(const Skeleton& skeleton, const ChildTable& table, double round_turn_degrees)
      : internodes_(skeleton.internodes),
        table_(table),
        least_cosine_(round_turn_degrees < 180 ? std::cos(round_turn_degrees * std::numbers::pi / 180) : -2) {
    resize_large(plans_, internodes_.size());
  }

  std::vector<JointPlan> run() {
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      plans_[i].fades_at_tip = !children_of(i).empty() && !turns_sharply(i);
      const InternodeId parent = internodes_[i].parent;
      plans_[i].fades_at_base = parent != kNoInternode && plans_[static_cast<std::size_t>(parent)].fades_at_tip;
    }
    // Children before parents: a sharp joint may leave its internode too short to fade in.
    for (std::size_t i = internodes_.size(); i-- > 0;) {
      if (has_sharp_tip(i) && plans_[i].fades_at_base && length(i) < fade_end(i)) start_sharply(i);
    }
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      if (has_sharp_tip(i)) end_sharply(i);
    }
    return std::move(plans_);
  }

 private:
  std::span<const InternodeId> children_of(std::size_t i) const {
    return std::span(table_.children).subspan(table_.first[i], table_.first[i + 1] - table_.first[i]);
  }
  const Internode& internode(InternodeId id) const { return internodes_[static_cast<std::size_t>(id)]; }
  double length(std::size_t i) const { return glm::distance(internodes_[i].base, internodes_[i].tip); }
  bool has_sharp_tip(std::size_t i) const { return !plans_[i].fades_at_tip && !children_of(i).empty(); }

  bool turns_sharply(std::size_t i) const {
    const Vec3 before = internodes_[i].tip - internodes_[i].base;
    Vec3 after(0);
    double thickest = 0;
    for (const InternodeId id : children_of(i)) {
      const Internode& child = internode(id);
      thickest = std::max(thickest, child.base_radius);
      after += child.base_radius * child.base_radius * glm::normalize(child.tip - child.base);
    }
    if (children_of(i).size() > 1 && thickest < kLeaderRadius * internodes_[i].tip_radius) return false;
    return glm::dot(before, after) < least_cosine_ * glm::length(before) * glm::length(after);
  }

  // Where an internode that fades in has done so.
  double fade_end(std::size_t i) const {
    return internode(internodes_[i].parent).tip_radius + internodes_[i].base_radius;
  }

  // A round cap on its parent's axis instead of the fade. Unless it is too thin for the cap to reach through the bark
  // on the far side, its siblings do the same.
  void start_sharply(std::size_t i) {
    plans_[i].fades_at_base = false;
    const auto parent = static_cast<std::size_t>(internodes_[i].parent);
    const auto siblings = children_of(parent);
    if (siblings.size() > 1 && 3 * internodes_[i].base_radius < 2 * internodes_[parent].tip_radius) return;
    plans_[parent].fades_at_tip = false;
    for (const InternodeId sibling : siblings) plans_[static_cast<std::size_t>(sibling)].fades_at_base = false;
  }

  void end_sharply(std::size_t i) {
    double thickest = 0;
    for (const InternodeId child : children_of(i)) thickest = std::max(thickest, internode(child).base_radius);
    const double shortening = kShortening * thickest;
    const double least = plans_[i].fades_at_base ? fade_end(i) : kLeastShortened * internodes_[i].base_radius;
    if (length(i) - shortening > least) {
      plans_[i].shortening = shortening;
    } else {
      plans_[i].is_united = true;
    }
  }

  const std::vector<Internode>& internodes_;
  const ChildTable& table_;
  const double least_cosine_;
  std::vector<JointPlan> plans_;
};

}  // namespace

std::vector<JointPlan> plan_joints(const Skeleton& skeleton, const ChildTable& table, double round_turn_degrees) {
  return Planner(skeleton, table, round_turn_degrees).run();
}

}  // namespace barkridge
