#include "blobtree/plant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/graded.h"

namespace barkridge {

namespace {

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

// The table without what is shed.
ChildTable standing_children(const Skeleton& skeleton, ChildTable table) {
  if (skeleton.scars.empty()) return table;
  std::vector<bool> is_shed(skeleton.internodes.size());
  for (const Scar& scar : skeleton.scars) is_shed[static_cast<std::size_t>(scar.internode)] = true;
  std::uint32_t kept = 0, next = 0;
  for (std::size_t i = 0; i + 1 < table.first.size(); ++i) {
    const std::uint32_t end = table.first[i + 1];
    table.first[i] = kept;
    for (; next < end; ++next) {
      const InternodeId child = table.children[next];
      if (!is_shed[static_cast<std::size_t>(child)]) table.children[kept++] = child;
    }
  }
  table.first.back() = kept;
  table.children.resize(kept);
  return table;
}

template <typename Primitive>
NodeId add_bent(BlobTree& tree, Primitive primitive, const Internode& a, const Arc& arc) {
  if (!(arc.angle_degrees > 0)) return tree.add(primitive);
  // The child is straight and as long as the arc; its ends stay as far from the arc's ends as they were from the
  // chord's.
  const Bend bend{a.base, a.tip, arc.direction, arc.angle_degrees};
  const Vec3 axis = (bend.tip - bend.base) / glm::distance(bend.base, bend.tip);
  primitive.tip += (arc_length(bend) - glm::distance(bend.base, bend.tip)) * axis;
  return tree.add(bend, {tree.add(primitive)});
}

double taper_of(const Internode& a) { return (a.tip_radius - a.base_radius) / glm::distance(a.base, a.tip); }

template <typename Marked>
const Marked* find(const std::vector<Marked>& all, std::size_t i) {
  if (all.empty()) return nullptr;
  const auto id = static_cast<InternodeId>(i);
  const auto at = std::lower_bound(all.begin(), all.end(), id,
                                   [](const Marked& marked, InternodeId wanted) { return marked.internode < wanted; });
  return at != all.end() && at->internode == id ? &*at : nullptr;
}

}  // namespace

Plant::Plant(const Skeleton& skeleton, std::span<const Arc> arcs, const TreeOptions& options)
    : skeleton_(skeleton), arcs_(arcs), options_(options), table_(child_table(skeleton)) {
  if (options.joint == JointKind::kFaded) {
    plans_ = plan_joints(skeleton, arcs, standing_children(skeleton, table_), options.round_turn_degrees);
  }
  const auto require_bare = [&](const auto& marked, const char* what) {
    InternodeId last = kNoInternode;
    for (const auto& m : marked) {
      const bool ordered = last < m.internode && m.internode < static_cast<InternodeId>(size());
      if (!ordered || !children_of(static_cast<std::size_t>(m.internode)).empty()) {
        throw InputError(
            fmt::format("{} of internode {}: expected internodes without children, in their order", what, m.internode));
      }
      last = m.internode;
    }
  };
  require_bare(skeleton.cut_ends, "a cut end");
  require_bare(skeleton.scars, "a scar");
  plan_displacement();
  for (const Scar& scar : skeleton.scars) {
    check(scar.shape);
    const auto i = static_cast<std::size_t>(scar.internode);
    if (internode(i).parent == kNoInternode || cut_end_of(i)) {
      throw InputError(fmt::format("a scar of internode {}: expected one with a parent and without a cut", i));
    }
  }
}

const CutEnd* Plant::cut_end_of(std::size_t i) const { return find(skeleton_.cut_ends, i); }
const Scar* Plant::scar_of(std::size_t i) const { return find(skeleton_.scars, i); }

Neighbourhood Plant::neighbourhood_of(std::size_t i) const {
  Neighbourhood near;
  for (const InternodeId child : children_of(i)) {
    if (scar_of(static_cast<std::size_t>(child))) continue;
    ++near.child_count;
    near.thickest_child = std::max(near.thickest_child, internode(static_cast<std::size_t>(child)).base_radius);
  }
  const InternodeId parent = internode(i).parent;
  if (parent == kNoInternode) return near;
  near.parent = &internode(static_cast<std::size_t>(parent));
  const auto siblings = children_of(static_cast<std::size_t>(parent));
  int standing = 0;
  for (std::size_t k = 0; k < siblings.size() && standing < 2; ++k) {
    standing += scar_of(static_cast<std::size_t>(siblings[k])) == nullptr;
  }
  near.shares_base = standing > 1;
  return near;
}

void Plant::plan_displacement() {
  const DisplacementOptions& stated = options_.displacement;
  if (!(0 <= stated.amount && stated.amount < 0.5)) {
    throw InputError(fmt::format("displacement {} is outside its range: 0 <= amount < 0.5", stated.amount));
  }
  if (stated.amount == 0) return;
  double thickest = 0;
  for (const Internode& a : skeleton_.internodes) thickest = std::max({thickest, a.base_radius, a.tip_radius});
  if (thickest == 0) return;
  noise_ = {stated.wavelength.value_or(kFurrowWidth * thickest), stated.stretch, stated.octaves, stated.ridged,
            stated.seed};
  check(Node{Displacement{stated.amount, noise_}, {0}});
  furrowed_radius_ = stated.furrowed_radius.value_or(0.5 * thickest);
  if (!(furrowed_radius_ > 0)) throw InputError("displacement: furrowed_radius must be above zero");
}

double Plant::displacement_of(const Internode& a) const {
  if (!is_displaced()) return 0;
  const double radius = 0.5 * (a.base_radius + a.tip_radius);
  return options_.displacement.amount * smooth_step(0.55, 1.6, radius / furrowed_radius_).value;
}

std::variant<Cone, FadedCone> Plant::primitive(std::size_t i) const {
  const Internode& a = internode(i);
  const Neighbourhood near = neighbourhood_of(i);
  const auto with_cut = [&](auto primitive) {
    if (const CutEnd* end = cut_end_of(i)) {
      const Vec3 axis = (a.tip - a.base) / glm::distance(a.base, a.tip);
      const double past = length_past_cut(a, end_tangent(a, arc(i)), *end);
      primitive.tip += past * axis;
      primitive.tip_radius += past * taper_of(a);
    }
    return primitive;
  };
  if (options_.joint == JointKind::kPaper) return with_cut(paper_cone(a, near, options_.junction));
  return with_cut(faded_cone(a, near, plans_[i]));
}

NodeId Plant::add_primitive(BlobTree& tree, std::size_t i) const {
  const Internode& a = internode(i);
  const NodeId whole = std::visit([&](const auto& shape) { return add_bent(tree, shape, a, arc(i)); }, primitive(i));
  const double amount = displacement_of(a);
  return amount > 0 ? tree.add(Displacement{amount, noise_}, {whole}) : whole;
}

double length_past_cut(const Internode& internode, const Vec3& axis, const CutEnd& end) {
  const double cosine = std::max(0.1, glm::dot(axis, end.normal));
  const double tangent = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
  const double wanted = (0.25 + tangent + end.splinters) * internode.tip_radius;
  // A cone that ends before ends so by itself.
  const double taper = taper_of(internode);
  return taper < 0 ? std::min(wanted, -0.9 * internode.tip_radius / taper) : wanted;
}

}  // namespace barkridge
