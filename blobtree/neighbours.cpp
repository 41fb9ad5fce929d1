#include "blobtree/neighbours.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace barkridge {

namespace {

// Holds all that an internode's field reaches.
Box support_box(const Plant& plant, std::size_t i) {
  const Internode& a = plant.internode(i);
  const CutEnd* end = plant.cut_end_of(i);
  const double past = end ? length_past_cut(a, end_tangent(a, plant.arc(i)), *end) : 0;
  // A bent axis keeps within its chord's length times half the tangent of a quarter of the angle.
  const double quarter = 0.25 * plant.arc(i).angle_degrees * std::numbers::pi / 180;
  const double bulge = 0.5 * glm::distance(a.base, a.tip) * std::tan(quarter);
  const double thickest = std::max(a.base_radius, a.tip_radius) + past;
  double reach = 2 * thickest;
  for (const InternodeId child : plant.children_of(i)) {
    reach = std::max(reach, a.tip_radius + plant.internode(static_cast<std::size_t>(child)).base_radius);
  }
  // Fading cones reach three radii past their ends.
  return grown(unite(Box{a.base, a.base}, a.tip), std::max(reach, 3 * thickest) + bulge);
}

}  // namespace

Neighbours::Neighbours(const Plant& plant) : plant_(plant) {
  std::vector<Box> boxes;
  boxes.reserve(plant.size());
  for (std::size_t i = 0; i < plant.size(); ++i) boxes.push_back(support_box(plant, i));
  supports_ = BoxHierarchy(boxes);
}

std::vector<std::uint32_t> Neighbours::near(const Box& box) const {
  std::vector<std::uint32_t> found;
  supports_.find(box, plant_.size(), found);
  return found;
}

std::optional<NodeId> Neighbours::add_field_of(const std::vector<std::uint32_t>& some, BlobTree& tree) const {
  std::vector<std::vector<NodeId>> joined(some.size());  // what stands on each one's tip
  std::vector<NodeId> apart;
  for (std::size_t k = some.size(); k-- > 0;) {
    const std::optional<NodeId> here = add_subtree(some[k], join(joined[k], tree), tree);
    if (!here) continue;
    const InternodeId parent = plant_.internode(some[k]).parent;
    const auto at = parent == kNoInternode
                        ? some.end()
                        : std::lower_bound(some.begin(), some.end(), static_cast<std::uint32_t>(parent));
    const bool is_here = at != some.end() && *at == static_cast<std::uint32_t>(parent);
    (is_here ? joined[static_cast<std::size_t>(at - some.begin())] : apart).push_back(*here);
  }
  if (apart.size() < 2) return apart.empty() ? std::nullopt : std::optional(apart[0]);
  return tree.add(Union{}, std::move(apart));
}

std::optional<NodeId> Neighbours::join(std::vector<NodeId>& branches, BlobTree& tree) const {
  if (branches.size() < 2) return branches.empty() ? std::nullopt : std::optional(branches[0]);
  if (plant_.options().junction == JunctionKind::kSmooth) return tree.add(Sum{}, std::move(branches));
  return tree.add(Contact{plant_.options().contact}, std::move(branches));
}

std::optional<NodeId> Neighbours::add_subtree(std::size_t i, std::optional<NodeId> beyond, BlobTree& tree) const {
  if (plant_.scar_of(i)) return beyond;
  NodeId node = plant_.add_primitive(tree, i);
  if (const CutEnd* end = plant_.cut_end_of(i)) node = tree.add(Difference{}, {node, tree.add(cutter(plant_, *end))});
  return beyond ? tree.add(Sum{}, {node, *beyond}) : node;
}

Disc cutter(const Plant& plant, const CutEnd& end) {
  const auto i = static_cast<std::size_t>(end.internode);
  const Internode& a = plant.internode(i);
  const Vec3 axis = end_tangent(a, plant.arc(i));
  const double cosine = glm::dot(axis, end.normal), tangent = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
  const double past = length_past_cut(a, axis, end);
  const double taper = (a.tip_radius - a.base_radius) / glm::distance(a.base, a.tip);
  const double reach = 2 * std::max(a.tip_radius, a.tip_radius + taper * past);
  constexpr double kMargin = 1.05;
  Disc disc;
  disc.normal = end.normal;
  disc.radius = kMargin * 0.5 * (past * cosine + reach);
  disc.center = a.tip + disc.radius / cosine * axis;
  disc.disc_radius = kMargin * (reach / cosine + disc.radius * tangent);
  return disc;
}

}  // namespace barkridge
