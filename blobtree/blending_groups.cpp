#include "blobtree/blending_groups.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/large_room.h"
#include "blobtree/box_hierarchy.h"
#include "blobtree/cone_record.h"
#include "blobtree/cylinder.h"
#include "blobtree/ray_bundle.h"

namespace barkridge {

namespace {

// Holds all points at which an internode's field is other than zero.
Cylinder support_cylinder(const Plant& plant, std::size_t i) {
  const Internode& a = plant.internode(i);
  const ConeRecord cone = std::visit([](const auto& shape) { return record_of(shape, 1); }, plant.primitive(i));
  const ConeKind kind = cone.has_free_base() && cone.has_free_tip() ? ConeKind::kPlain : kind_of_faded(cone);
  const auto [along, lateral] = support_of(cone, kind);
  const double length = glm::distance(a.base, a.tip), radians = plant.arc(i).angle_degrees * std::numbers::pi / 180;
  // An arc keeps within the chord's length times half the tangent of a quarter of its angle, and what is past its ends
  // goes on straight, at half its angle to the chord.
  const double past = std::max({0.0, -along.lo, along.hi - length});
  const double aside = 0.5 * length * std::tan(0.25 * radians) + past * std::sin(0.5 * radians);
  const double half = 0.5 * std::max(0.0, along.hi - along.lo);
  const Vec3 axis = (a.tip - a.base) / length;
  return {cone.base + 0.5 * (along.lo + along.hi) * axis, axis, half, lateral + aside};
}

class GroupFinder {
 public:
  GroupFinder(const Plant& plant, std::span<const std::uint32_t> undivided)
      : plant_(plant), divides_(plant.size()), known_(plant.size()) {
    find_junctions();
    resize_large(supports_, plant.size());
    tbb::parallel_for(std::size_t{0}, plant.size(), [&](std::size_t i) {
      if (stands(i)) supports_[i] = support_cylinder(plant_, i);
    });
    std::vector<Box> boxes;
    reserve_large(boxes, plant.size());
    for (const Cylinder& support : supports_) boxes.push_back(box_around(support));
    near_ = BoxHierarchy(boxes);
    for (std::size_t i = 0; i < plant.size(); ++i) divides_[i] = stands(i) && !plant.children_of(i).empty();
    for (const std::uint32_t i : undivided) join_ends(i);
  }

  std::vector<bool> run() {
    while (join_where_needed()) {
    }
    return {divides_.begin(), divides_.end()};
  }

 private:
  // What is shed stands nowhere.
  bool stands(std::size_t i) const { return plant_.scar_of(i) == nullptr; }

  // Junctions are known by the internode at whose tip they are; those on the ground, where roots start, come after.
  void find_junctions() {
    resize_large(base_junctions_, plant_.size());
    for (std::size_t i = 0; i < plant_.size(); ++i) {
      base_junctions_[i] = static_cast<std::uint32_t>(plant_.internode(i).parent);
    }
    std::map<std::tuple<double, double, double>, std::size_t> grounds;
    for (const InternodeId root : plant_.children_of(plant_.size())) {
      const Vec3& base = plant_.internode(static_cast<std::size_t>(root)).base;
      const auto [ground, is_new] = grounds.emplace(std::tuple(base.x, base.y, base.z), roots_.size());
      if (is_new) roots_.emplace_back();
      roots_[ground->second].push_back(root);
      base_junctions_[static_cast<std::size_t>(root)] = static_cast<std::uint32_t>(plant_.size() + ground->second);
    }
    resize_large(links_, plant_.size() + roots_.size());
    for (std::uint32_t k = 0; k < links_.size(); ++k) links_[k] = {k, 1, k};
  }
  std::span<const InternodeId> starting_at(std::uint32_t junction) const {
    return junction < plant_.size() ? plant_.children_of(junction) : roots_[junction - plant_.size()];
  }

  std::uint32_t group_of(std::uint32_t junction) const {
    while (links_[junction].above != junction) junction = links_[junction].above;
    return junction;
  }
  std::uint32_t base_group(std::size_t i) const { return group_of(base_junctions_[i]); }
  std::uint32_t tip_group(std::size_t i) const { return group_of(static_cast<std::uint32_t>(i)); }

  // The smaller group joins the larger one, so that no way to a group's name is long.
  void join_ends(std::size_t i) {
    divides_[i] = 0;
    std::uint32_t a = base_group(i), b = tip_group(i);
    if (a == b) return;
    if (links_[a].size < links_[b].size) std::swap(a, b);
    links_[b].above = a;
    links_[a].size += links_[b].size;
    std::swap(links_[a].next, links_[b].next);
  }

  // Looks at all internodes that divide groups of which one has changed since, and joins those that must be one.
  // Returns whether there were any.
  bool join_where_needed() {
    std::vector<std::uint8_t> joins(plant_.size());
    tbb::parallel_for(std::size_t{0}, plant_.size(), [&](std::size_t i) {
      if (!divides_[i]) return;
      const std::uint32_t size = links_[base_group(i)].size + links_[tip_group(i)].size;
      if (std::exchange(known_[i], size) != size) joins[i] = meets_across(i);
    });
    bool any = false;
    for (std::size_t i = 0; i < plant_.size(); ++i) {
      if (!joins[i]) continue;
      join_ends(i);
      any = true;
    }
    return any;
  }

  // Whether one of the internodes in the group at its base and one in that at its tip may be other than zero beside the
  // same place of its axis, within its own support.
  bool meets_across(std::size_t i) const {
    std::uint32_t smaller = base_group(i), larger = tip_group(i);
    if (links_[larger].size < links_[smaller].size) std::swap(smaller, larger);
    thread_local std::vector<Interval> of_smaller, of_larger;
    find_beside(i, smaller, {0, 2 * supports_[i].half_length}, of_smaller);
    Interval within;
    for (const Interval& a : of_smaller) within = {std::min(within.lo, a.lo), std::max(within.hi, a.hi)};
    if (within.empty()) return false;
    find_beside(i, larger, within, of_larger);
    return std::any_of(of_smaller.begin(), of_smaller.end(), [&](const Interval& a) {
      return std::any_of(of_larger.begin(), of_larger.end(),
                         [&](const Interval& b) { return std::max(a.lo, b.lo) <= std::min(a.hi, b.hi); });
    });
  }

  // Beside which parts of a part of an internode's support the others of a group may be other than zero.
  void find_beside(std::size_t i, std::uint32_t group, const Interval& part, std::vector<Interval>& found) const {
    const Cylinder& own = supports_[i];
    const Ray axis{own.center - own.half_length * own.axis, own.axis};
    found.clear();
    for (const std::uint32_t other : candidates(group, axis, part, own.radius)) {
      if (other == i || !stands(other) || (base_group(other) != group && tip_group(other) != group)) continue;
      // Beside a place of the axis a point is off it at right angles.
      Cylinder reach = supports_[other];
      const double cosine = glm::dot(reach.axis, own.axis);
      reach.half_length += own.radius * std::sqrt(std::max(0.0, 1 - cosine * cosine));
      reach.radius += own.radius;
      RayRanges beside;
      if (clip(RayBundle(axis, part), 1, reach, beside) != 0) found.push_back(beside[0]);
    }
  }

  // All of a group, or where that is large all near a part of an axis, of whatever group.
  std::span<const std::uint32_t> candidates(std::uint32_t group, const Ray& axis, const Interval& part,
                                            double radius) const {
    thread_local std::vector<std::uint32_t> found;
    found.clear();
    constexpr std::uint32_t kMostListed = 64;
    if (links_[group].size > kMostListed) {
      near_.find(
          box_around(Cylinder{axis.at(0.5 * (part.lo + part.hi)), axis.direction, 0.5 * (part.hi - part.lo), radius}),
          plant_.size(), found);
      return found;
    }
    std::uint32_t junction = group;
    do {
      if (junction < plant_.size()) found.push_back(junction);
      for (const InternodeId id : starting_at(junction)) found.push_back(static_cast<std::uint32_t>(id));
      junction = links_[junction].next;
    } while (junction != group);
    return found;
  }

  struct Link {
    std::uint32_t above;
    std::uint32_t size;  // of a group, where it is that of its name
    std::uint32_t next;  // the next junction of the group, in a circle
  };

  const Plant& plant_;
  BoxHierarchy near_;                            // over the supports
  std::vector<Cylinder> supports_;               // by internode
  std::vector<std::uint32_t> base_junctions_;    // by internode
  std::vector<std::vector<InternodeId>> roots_;  // by junction on the ground
  std::vector<Link> links_;                      // by junction
  std::vector<std::uint8_t> divides_;            // by internode
  std::vector<std::uint32_t> known_;             // by internode: how large its groups were when they were looked at
};

}  // namespace

std::vector<bool> ends_of_blending(const Plant& plant, std::span<const std::uint32_t> undivided) {
  return GroupFinder(plant, undivided).run();
}

}  // namespace barkridge
