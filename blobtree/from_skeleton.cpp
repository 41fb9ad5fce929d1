#include "blobtree/from_skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <tuple>

#include "base/error.h"
#include "base/large_room.h"
#include "blobtree/joint_plan.h"

namespace barkridge {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Influence reaches two radii from the axis; a bent axis keeps at least this multiple of it to its arc's centre.
constexpr double kBendClearance = 1.25;

// What meets at a junction is taken to have died out on an internode so many of the thickest radii away from it.
constexpr double kJunctionReach = 2;

// What an internode's primitive must know of its neighbours.
struct Neighbourhood {
  const Internode* parent = nullptr;
  bool shares_base = false;  // with other children of its parent
  std::size_t child_count = 0;
  double thickest_child = 0;  // base radius
};

// [GMW04, eqs. 4, 7, 8] Radii stay on the internode's taper line; at least a sphere is left.
Cone paper_cone(const Internode& a, const Neighbourhood& near, JunctionKind junction) {
  const double length = glm::distance(a.base, a.tip);
  double start = 0, shortening = 0;
  if (near.parent && near.shares_base && junction == JunctionKind::kRidge) {
    start = std::clamp(near.parent->tip_radius - a.base_radius, 0.0, length);
  }
  if (near.child_count > 1 && junction == JunctionKind::kRidge) {
    shortening = 2.75 * near.thickest_child - a.tip_radius;
  } else if (near.child_count > 0) {
    shortening = 1.75 * near.thickest_child;
  }
  const double end = std::max(start, length - shortening);
  const Vec3 axis = (a.tip - a.base) / length;
  const double taper = (a.tip_radius - a.base_radius) / length;
  const double thinnest = 1e-3 * std::min(a.base_radius, a.tip_radius);
  return {a.base + start * axis, a.base + end * axis, a.base_radius + taper * start,
          std::max(thinnest, a.base_radius + taper * end)};
}

// Radii stay on the internode's taper line where its tip is shortened.
FadedCone faded_cone(const Internode& a, const Neighbourhood& near, const JointPlan& plan) {
  const double part = 1 - plan.shortening / glm::distance(a.base, a.tip);
  return {a.base,
          a.base + part * (a.tip - a.base),
          a.base_radius,
          a.base_radius + part * (a.tip_radius - a.base_radius),
          plan.fades_at_base ? near.parent->tip_radius : 0.0,
          plan.fades_at_tip ? near.thickest_child : 0.0};
}

// The bend of an internode in the plane of its axis and its parent's, so that it starts farther away from the parent's
// direction; angle 0 where the two are collinear. [GMW04, section 3.6]
Bend bend_of(const Internode& a, const Neighbourhood& near, double angle_degrees) {
  Bend bend{a.base, a.tip, Vec3(0), 0};
  if (!near.parent) return bend;
  const double length = glm::distance(a.base, a.tip);
  const Vec3 axis = (a.tip - a.base) / length;
  const Vec3 basal = glm::normalize(near.parent->tip - near.parent->base);
  const Vec3 away = -(basal - glm::dot(basal, axis) * axis);
  constexpr double kCollinear = 1e-6;
  if (glm::length(away) < kCollinear) return bend;
  bend.direction = glm::normalize(away);
  const double clearance = kBendClearance * 4 * std::max(a.base_radius, a.tip_radius);
  const double widest = 2 * std::asin(std::min(1.0, length / clearance)) / kRadiansPerDegree;
  bend.angle_degrees = std::min(angle_degrees, widest);
  return bend;
}

template <typename Primitive>
NodeId add_bent(BlobTree& tree, Primitive primitive, const Bend& bend) {
  if (!(bend.angle_degrees > 0)) return tree.add(primitive);
  // The child is straight and as long as the arc; its ends stay as far from the arc's ends as they were from the
  // chord's.
  const Vec3 axis = (bend.tip - bend.base) / glm::distance(bend.base, bend.tip);
  primitive.tip += (arc_length(bend) - glm::distance(bend.base, bend.tip)) * axis;
  return tree.add(bend, {tree.add(primitive)});
}

// Nodes that are to be summed: a subtree before anything but a sum has needed it as one node. Each is linked to the
// next, so that rows of any length become one at no cost.
struct Summands {
  NodeId first = 0, last = 0;
  std::uint32_t count = 0;
};

class TreeBuilder {
 public:
  TreeBuilder(const Skeleton& skeleton, const TreeOptions& options)
      : skeleton_(skeleton), internodes_(skeleton.internodes), options_(options), table_(child_table(skeleton)) {
    reserve_large(thickest_child_, internodes_.size());
    thickest_child_.resize(internodes_.size(), 0);
    for (const Internode& child : internodes_) {
      if (child.parent == kNoInternode) continue;
      double& thickest = thickest_child_[static_cast<std::size_t>(child.parent)];
      thickest = std::max(thickest, child.base_radius);
    }
    if (options.joint == JointKind::kFaded) plans_ = plan_joints(skeleton, table_, options.round_turn_degrees);
    resize_large(subtrees_, internodes_.size());
    const std::size_t most = most_nodes();
    reserve_large(tree_.nodes, most);
    resize_large(next_, most);
  }

  BlobTree run() {
    // Children before parents: the summands of a subtree move up the axis and become a node where branches touch. A
    // long internode ends them where blending is confined: what meets at its tip is a group of its own.
    std::vector<NodeId> apart;
    for (std::size_t i = internodes_.size(); i-- > 0;) {
      Summands subtree = join(static_cast<InternodeId>(i), children_of(i));
      const Summands internode = single(add_internode(i));
      if (is_united(i)) {
        const NodeId carried = as_node(subtree);
        subtree = single(tree_.add(Union{}, {internode.first, carried}));
      } else {
        append(subtree, internode);
      }
      if (carries_group(i)) {
        apart.push_back(as_node(subtree));
        subtree = single(add_internode(i));
      }
      subtrees_[i] = subtree;
    }
    // Roots that start at one point are children of the ground there.
    std::map<std::tuple<double, double, double>, std::vector<InternodeId>> plants;
    for (const InternodeId root : children_of(internodes_.size())) {
      const Vec3& base = internodes_[static_cast<std::size_t>(root)].base;
      plants[{base.x, base.y, base.z}].push_back(root);
    }
    for (const auto& [base, roots] : plants) {
      // A root by itself adds nothing to the group that it carries.
      if (roots.size() > 1 || !carries_group(static_cast<std::size_t>(roots.front()))) {
        apart.push_back(as_node(join(kNoInternode, roots)));
      }
    }
    if (apart.size() > 1)
      tree_.add(Union{}, std::move(apart));
    else if (apart.size() == 1)
      tree_.root = apart.front();
    return std::move(tree_);
  }

 private:
  std::span<const InternodeId> children_of(std::size_t i) const {
    return std::span(table_.children).subspan(table_.first[i], table_.first[i + 1] - table_.first[i]);
  }

  // A primitive and perhaps a bend for every internode, and again with a sum where it carries a group; a union and a
  // sum where it is united with what it carries; a contact where branches touch, and a sum for each of several
  // internodes; what joins the roots.
  std::size_t most_nodes() const {
    const std::size_t for_each = options_.bend_angle_degrees > 0 ? 2 : 1;
    std::size_t most = internodes_.size() * for_each;
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      most += (carries_group(i) ? for_each + 1 : 0) + (is_united(i) ? 2 : 0);
    }
    most += 3 * children_of(internodes_.size()).size() + 1;
    if (options_.junction == JunctionKind::kSmooth) return most;
    for (std::size_t i = 0; i < internodes_.size(); ++i) {
      const auto children = children_of(i);
      if (children.size() < 2) continue;
      most += 1 + static_cast<std::size_t>(std::count_if(children.begin(), children.end(), [&](InternodeId child) {
                return !children_of(static_cast<std::size_t>(child)).empty();
              }));
    }
    return most;
  }

  Neighbourhood neighbourhood_of(std::size_t i) const {
    Neighbourhood near;
    const auto children = children_of(i);
    near.child_count = children.size();
    near.thickest_child = thickest_child_[i];
    if (const InternodeId parent = internodes_[i].parent; parent != kNoInternode) {
      near.parent = &internodes_[static_cast<std::size_t>(parent)];
      near.shares_base = children_of(static_cast<std::size_t>(parent)).size() > 1;
    }
    return near;
  }

  NodeId add_internode(std::size_t i) {
    const Internode& a = internodes_[i];
    const Neighbourhood near = neighbourhood_of(i);
    const Bend bend = bend_of(a, near, options_.bend_angle_degrees);
    return options_.joint == JointKind::kPaper ? add_bent(tree_, paper_cone(a, near, options_.junction), bend)
                                               : add_bent(tree_, faded_cone(a, near, plans_[i]), bend);
  }

  bool is_united(std::size_t i) const { return options_.joint == JointKind::kFaded && plans_[i].is_united; }

  // Whether blending ends at an internode: it has children, and what meets at its base has died out where what meets at
  // its tip begins.
  bool carries_group(std::size_t i) const {
    if (options_.blending != BlendingKind::kConfined || children_of(i).empty()) return false;
    const Internode& a = internodes_[i];
    const double at_tip = std::max(a.tip_radius, thickest_child_[i]);
    double at_base = a.base_radius;
    if (a.parent != kNoInternode) {
      const auto parent = static_cast<std::size_t>(a.parent);
      at_base = std::max({at_base, internodes_[parent].tip_radius, thickest_child_[parent]});
    }
    return glm::distance(a.base, a.tip) > kJunctionReach * (at_base + at_tip);
  }

  static Summands single(NodeId node) { return {node, node, 1}; }

  void append(Summands& row, const Summands& more) {
    if (row.count == 0) {
      row = more;
    } else {
      next_[row.last] = more.first;
      row = {row.first, more.last, row.count + more.count};
    }
  }

  NodeId as_node(const Summands& summands) {
    if (summands.count == 1) return summands.first;
    std::vector<NodeId> nodes(summands.count);
    NodeId next = summands.first;
    for (NodeId& node : nodes) {
      node = next;
      next = next_[next];
    }
    return tree_.add(Sum{}, std::move(nodes));
  }

  // What branches that start at one point are together.
  Summands join(InternodeId carrier, std::span<const InternodeId> branches) {
    const auto subtree_of = [&](InternodeId branch) { return subtrees_[static_cast<std::size_t>(branch)]; };
    if (branches.size() > 1 && options_.junction == JunctionKind::kRidge) {
      std::vector<NodeId> nodes;
      nodes.reserve(branches.size());
      for (const InternodeId branch : branches) nodes.push_back(as_node(subtree_of(branch)));
      const ContactShape shape = contact_shape_of(skeleton_, carrier, branches, options_.ridge_rules, options_.contact);
      return single(tree_.add(Contact{shape}, std::move(nodes)));
    }
    Summands all;
    for (const InternodeId branch : branches) {
      Summands subtree = subtree_of(branch);
      if (subtree.count > all.count) std::swap(all, subtree);
      if (subtree.count > 0) append(all, subtree);
    }
    return all;
  }

  const Skeleton& skeleton_;
  const std::vector<Internode>& internodes_;
  const TreeOptions& options_;
  const ChildTable table_;
  std::vector<JointPlan> plans_;        // by internode, of faded joints
  std::vector<double> thickest_child_;  // base radius, by internode
  BlobTree tree_;
  std::vector<NodeId> next_;        // by node: what it is followed by among summands
  std::vector<Summands> subtrees_;  // by internode
};

}  // namespace

BlobTree tree_from_skeleton(const Skeleton& skeleton, const TreeOptions& options) {
  check(options.contact);
  for (const RidgeRule& rule : options.ridge_rules) check(rule.contact);
  for (const Ridge& ridge : skeleton.ridges) {
    check(ContactShape{ridge.width, ridge.swelling, options.contact.allow_large_swelling});
  }
  if (!(0 <= options.round_turn_degrees && options.round_turn_degrees <= 180)) {
    throw InputError(
        fmt::format("round turn {} is outside its range: 0 <= round_turn_degrees <= 180", options.round_turn_degrees));
  }
  if (!(0 <= options.bend_angle_degrees && options.bend_angle_degrees < 180)) {
    throw InputError(
        fmt::format("bend angle {} is outside its range: 0 <= angle_degrees < 180", options.bend_angle_degrees));
  }
  return TreeBuilder(skeleton, options).run();
}

}  // namespace barkridge
