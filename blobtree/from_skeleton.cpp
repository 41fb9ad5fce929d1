#include "blobtree/from_skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "base/error.h"

namespace barkridge {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Influence reaches two radii from the axis; a bent axis keeps at least this multiple of it to its arc's centre.
constexpr double kBendClearance = 1.25;

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

FadedCone faded_cone(const Internode& a, const Neighbourhood& near) {
  return {a.base, a.tip, a.base_radius, a.tip_radius, near.parent ? near.parent->tip_radius : 0.0, near.thickest_child};
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

NodeId add_primitive(BlobTree& tree, const Internode& a, const Neighbourhood& near, const TreeOptions& options) {
  const Bend bend = bend_of(a, near, options.bend_angle_degrees);
  return options.joint == JointKind::kPaper ? add_bent(tree, paper_cone(a, near, options.junction), bend)
                                            : add_bent(tree, faded_cone(a, near), bend);
}

// Nodes that are to be summed: a subtree before anything but a sum has needed it as one node.
using Summands = std::vector<NodeId>;

NodeId as_node(BlobTree& tree, Summands summands) {
  if (summands.size() == 1) return summands.front();
  return tree.add(Sum{}, std::move(summands));
}

Summands join(BlobTree& tree, std::vector<Summands> subtrees, const TreeOptions& options) {
  if (subtrees.size() == 1) return std::move(subtrees.front());
  if (options.junction == JunctionKind::kSmooth) {
    Summands all;
    for (Summands& subtree : subtrees) {
      if (subtree.size() > all.size()) all.swap(subtree);
      all.insert(all.end(), subtree.begin(), subtree.end());
    }
    return all;
  }
  std::vector<NodeId> branches;
  for (Summands& subtree : subtrees) branches.push_back(as_node(tree, std::move(subtree)));
  return {tree.add(Contact{options.contact}, std::move(branches))};
}

}  // namespace

BlobTree tree_from_skeleton(const Skeleton& skeleton, const TreeOptions& options) {
  check(options.contact);
  if (!(0 <= options.bend_angle_degrees && options.bend_angle_degrees < 180)) {
    throw InputError(
        fmt::format("bend angle {} is outside its range: 0 <= angle_degrees < 180", options.bend_angle_degrees));
  }
  const std::vector<Internode>& internodes = skeleton.internodes;
  const ChildTable table = child_table(skeleton);
  const auto children_of = [&](std::size_t i) {
    return std::span(table.children).subspan(table.first[i], table.first[i + 1] - table.first[i]);
  };
  BlobTree tree;
  std::vector<Summands> subtrees(internodes.size());
  // Children before parents: the summands of a subtree move up the axis and become a node where branches touch.
  for (std::size_t i = internodes.size(); i-- > 0;) {
    const Internode& a = internodes[i];
    Neighbourhood near;
    std::vector<Summands> carried;
    for (const InternodeId child : children_of(i)) {
      near.thickest_child = std::max(near.thickest_child, internodes[static_cast<std::size_t>(child)].base_radius);
      carried.push_back(std::move(subtrees[static_cast<std::size_t>(child)]));
    }
    near.child_count = carried.size();
    if (a.parent != kNoInternode) {
      near.parent = &internodes[static_cast<std::size_t>(a.parent)];
      near.shares_base = children_of(static_cast<std::size_t>(a.parent)).size() > 1;
    }
    if (!carried.empty()) subtrees[i] = join(tree, std::move(carried), options);
    subtrees[i].push_back(add_primitive(tree, a, near, options));
  }
  // Roots that start at one point are children of the ground there.
  std::map<std::tuple<double, double, double>, std::vector<Summands>> plants;
  for (const InternodeId root : children_of(internodes.size())) {
    const Vec3& base = internodes[static_cast<std::size_t>(root)].base;
    plants[{base.x, base.y, base.z}].push_back(std::move(subtrees[static_cast<std::size_t>(root)]));
  }
  std::vector<NodeId> apart;
  for (auto& [base, roots] : plants) apart.push_back(as_node(tree, join(tree, std::move(roots), options)));
  if (apart.size() > 1)
    tree.add(Union{}, std::move(apart));
  else if (apart.size() == 1)
    tree.root = apart.front();
  return tree;
}

}  // namespace barkridge
