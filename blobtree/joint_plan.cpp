#include "blobtree/joint_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/large_room.h"

namespace barkridge {

namespace {

// An axis that turns by less is straight: fades round it by 3 % of its radius.
constexpr double kStraightDegrees = 5;

// Thinner branches that fade leave their carrier's tip round enough, whatever their turn; in tip radii of the carrier.
constexpr double kLeaderRadius = 0.8;
// The branches of a fork fill each other's outside, so that it may turn by so many times as much as an axis.
constexpr double kForkTurn = 2;

// By how much the tapers of two internodes may differ that fade into each other at a turn: extended past their joint
// they neck it by a quarter of the difference.
constexpr double kTaperChange = 0.03;

// A round cap of this radius on its carrier's axis does not reach its carrier's surface; in tip radii of the carrier.
constexpr double kHiddenRadius = 0.5;

// [GMW04, eq. 4], in radii at the joint, of two long internodes of one radius. Past a right angle they lie side by
// side and swell; a thinner child leaves a neck, a shorter one a gap, and a taper a ring of half its size.
constexpr double kShortening = 1.75;
constexpr double kLeastContinuing = 0.95;   // the child's base radius, in tip radii of the internode
constexpr double kSteepestTaper = 1. / 80;  // of the internode
constexpr double kLeastContinued = 3;       // the child's length, in its base radii
constexpr double kLeastShortened = 2;       // what is left of the internode between two round caps, likewise

class Planner {
 public:
  Planner(const Skeleton& skeleton, std::span<const Arc> arcs, const ChildTable& table, double round_turn_degrees)
      : internodes_(skeleton.internodes), arcs_(arcs), table_(table), round_turn_degrees_(round_turn_degrees) {
    resize_large(plans_, internodes_.size());
  }

  std::vector<JointPlan> run() {
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      plans_[i].fades_at_tip = !children_of(i).empty() && may_fade(i);
      const InternodeId parent = internodes_[i].parent;
      plans_[i].fades_at_base = parent != kNoInternode && plans_[static_cast<std::size_t>(parent)].fades_at_tip;
    }
    // Children before parents: a sharp joint may leave its internode too short to fade in.
    for (std::size_t i = internodes_.size(); i-- > 0;) {
      if (has_sharp_tip(i) && plans_[i].fades_at_base && length(i) < fade_end(i)) start_sharply(i);
    }
    // Parents before children: a round cap may leave its internode too short to fade out.
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      if (plans_[i].fades_at_tip && !plans_[i].fades_at_base && !is_straight(i) && fade_start(i) < 0) sharpen_tip(i);
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
  double taper(std::size_t i) const { return (internodes_[i].tip_radius - internodes_[i].base_radius) / length(i); }
  Arc arc(std::size_t i) const { return arcs_.empty() ? Arc{} : arcs_[i]; }
  bool has_sharp_tip(std::size_t i) const { return !plans_[i].fades_at_tip && !children_of(i).empty(); }
  bool is_continued(std::size_t i) const { return children_of(i).size() == 1; }
  std::size_t first_child(std::size_t i) const { return static_cast<std::size_t>(children_of(i).front()); }

  double thickest_child(std::size_t i) const {
    double thickest = 0;
    for (const InternodeId child : children_of(i)) thickest = std::max(thickest, internode(child).base_radius);
    return thickest;
  }

  // Of an internode's tip, in degrees, to the mean direction of its children.
  double turn(std::size_t i) const {
    const Vec3 before = end_tangent(internodes_[i], arc(i));
    Vec3 after(0);
    for (const InternodeId id : children_of(i)) {
      const auto child = static_cast<std::size_t>(id);
      const double radius = internodes_[child].base_radius;
      after += radius * radius * start_tangent(internodes_[child], arc(child));
    }
    return std::atan2(glm::length(glm::cross(before, after)), glm::dot(before, after)) * 180 / std::numbers::pi;
  }

  bool is_straight(std::size_t i) const { return is_continued(i) && turn(i) <= kStraightDegrees; }

  bool may_fade(std::size_t i) const {
    if (!is_continued(i)) {
      return turn(i) <= kForkTurn * round_turn_degrees_ ||
             thickest_child(i) < kLeaderRadius * internodes_[i].tip_radius;
    }
    if (is_straight(i)) return true;
    const std::size_t child = first_child(i);
    const bool ends_early = children_of(child).empty() && length(child) < fade_end(child);
    return turn(i) <= round_turn_degrees_ && !ends_early && std::abs(taper(i) - taper(child)) <= kTaperChange;
  }

  // Where an internode that fades in has done so, from its base; and where it begins to fade out.
  double fade_end(std::size_t i) const {
    return internode(internodes_[i].parent).tip_radius + internodes_[i].base_radius;
  }
  double fade_start(std::size_t i) const { return length(i) + internodes_[i].tip_radius - 2 * thickest_child(i); }

  void sharpen_tip(std::size_t i) {
    plans_[i].fades_at_tip = false;
    for (const InternodeId child : children_of(i)) plans_[static_cast<std::size_t>(child)].fades_at_base = false;
  }

  // A round cap on its parent's axis instead of the fade. Unless that is hidden within its parent, its siblings do the
  // same.
  void start_sharply(std::size_t i) {
    plans_[i].fades_at_base = false;
    const auto parent = static_cast<std::size_t>(internodes_[i].parent);
    const bool is_hidden = internodes_[i].base_radius <= kHiddenRadius * internodes_[parent].tip_radius;
    if (is_continued(parent) || !is_hidden) sharpen_tip(parent);
  }

  // The radius at the joint is the mean of those of the two caps there.
  void end_sharply(std::size_t i) {
    const Internode& a = internodes_[i];
    const std::size_t child = first_child(i);
    const double radius = 0.5 * (a.tip_radius + internodes_[child].base_radius) / (1 + 0.5 * kShortening * taper(i));
    const double least = plans_[i].fades_at_base ? fade_end(i) : kLeastShortened * a.base_radius;
    const bool closes = is_continued(i) && turn(i) <= 90 && std::abs(taper(i)) <= kSteepestTaper &&
                        internodes_[child].base_radius >= kLeastContinuing * a.tip_radius &&
                        length(child) >= kLeastContinued * internodes_[child].base_radius &&
                        length(i) - kShortening * radius > least;
    if (closes) {
      plans_[i].shortening = kShortening * radius;
    } else {
      plans_[i].is_united = true;
    }
  }

  const std::vector<Internode>& internodes_;
  const std::span<const Arc> arcs_;
  const ChildTable& table_;
  const double round_turn_degrees_;
  std::vector<JointPlan> plans_;
};

}  // namespace

std::vector<JointPlan> plan_joints(const Skeleton& skeleton, std::span<const Arc> arcs, const ChildTable& table,
                                   double round_turn_degrees) {
  return Planner(skeleton, arcs, table, round_turn_degrees).run();
}

}  // namespace barkridge
