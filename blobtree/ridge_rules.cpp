#include "blobtree/ridge_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace barkridge {

namespace {

const Internode& at(const Skeleton& skeleton, InternodeId id) {
  return skeleton.internodes[static_cast<std::size_t>(id)];
}

// By atan2, which keeps its digits at small and at flat angles.
double angle_between_degrees(const Internode& a, const Internode& b) {
  const Vec3 u = a.tip - a.base, v = b.tip - b.base;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) * 180 / std::numbers::pi;
}

}  // namespace

Fork fork_of(const Skeleton& skeleton, InternodeId carrier, std::span<const InternodeId> children) {
  const Internode* thickest = &at(skeleton, children[0]);
  const Internode* second = nullptr;
  for (const InternodeId id : children.subspan(1)) {
    const Internode* child = &at(skeleton, id);
    if (child->base_radius > thickest->base_radius) std::swap(child, thickest);
    if (!second || child->base_radius > second->base_radius) second = child;
  }
  return {carrier == kNoInternode ? 0 : at(skeleton, carrier).order, angle_between_degrees(*thickest, *second),
          second->base_radius / thickest->base_radius};
}

ContactShape contact_shape_of(const Skeleton& skeleton, InternodeId carrier, std::span<const InternodeId> children,
                              std::span<const RidgeRule> rules, const ContactShape& otherwise) {
  for (const InternodeId child : children) {
    const std::int32_t own = at(skeleton, child).ridge;
    if (own == kNoRidge) continue;
    const Ridge& ridge = skeleton.ridges[static_cast<std::size_t>(own)];
    return {ridge.width, ridge.swelling, otherwise.allow_large_swelling};
  }
  if (rules.empty()) return otherwise;
  const Fork fork = fork_of(skeleton, carrier, children);
  const auto last = std::find_if(rules.rbegin(), rules.rend(), [&](const RidgeRule& rule) { return rule.fits(fork); });
  return last == rules.rend() ? otherwise : last->contact;
}

}  // namespace barkridge
