#include "blobtree/primitive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blobtree/falloff.h"

namespace barkridge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The part of `v` across the unit vector `axis`, and its length's inverse-safe unit vector.
Vec3 across(const Vec3& v, const Vec3& axis) { return v - glm::dot(v, axis) * axis; }

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = glm::length(v);
  return length > 0 ? v / length : otherwise;
}

Vec3 any_across(const Vec3& axis) {
  Vec3 t, b;
  complete_frame(axis, t, b);
  return t;
}

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double t = squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
  return a + t * ab;
}

}  // namespace

Sphere nearest_sphere(const Cone& cone, const Vec3& p) {
  const Vec3 ab = cone.tip - cone.base;
  const double length = glm::length(ab);
  if (!(length > 0)) return {cone.base, std::max(cone.base_radius, cone.tip_radius)};
  const Vec3 axis = ab / length;
  const double taper = (cone.tip_radius - cone.base_radius) / length;
  const double y = glm::dot(p - cone.base, axis);
  const Vec3 beside = across(p - cone.base, axis);
  const double radius_at_foot = cone.base_radius + taper * y;
  const double thick_end = taper > 0 ? length : 0.0;
  const double best =
      radius_at_foot > 0 ? std::clamp(y + taper * glm::dot(beside, beside) / radius_at_foot, 0.0, length) : thick_end;
  return {cone.base + best * axis, cone.base_radius + taper * best};
}

Sphere nearest_sphere(const Disc& disc, const Vec3& p) {
  const Vec3 normal = glm::normalize(disc.normal);
  const Vec3 beside = across(p - disc.center, normal);
  const double distance = glm::length(beside);
  const double reach = std::min(distance, disc.disc_radius);
  return {distance > 0 ? disc.center + beside * (reach / distance) : disc.center, disc.radius};
}

Sphere nearest_sphere(const Ring& ring, const Vec3& p) {
  const Vec3 normal = glm::normalize(ring.normal);
  const Vec3 outward = unit_or(across(p - ring.center, normal), any_across(normal));
  return {ring.center + ring.ring_radius * outward, ring.radius};
}

Sphere nearest_sphere(const Polygon& polygon, const Vec3& p) {
  const auto& corners = polygon.vertices;
  Vec3 normal(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  normal = unit_or(normal, Vec3(0, 1, 0));
  const Vec3 foot = p - glm::dot(p - corners[0], normal) * normal;
  // The foot is inside when the boundary winds around it.
  double winding = 0;
  Vec3 nearest = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % corners.size()];
    winding += std::atan2(glm::dot(normal, glm::cross(a - foot, b - foot)), glm::dot(a - foot, b - foot));
    const Vec3 candidate = nearest_on_segment(a, b, p);
    if (glm::distance(candidate, p) < glm::distance(nearest, p)) nearest = candidate;
  }
  return {std::abs(winding) > 3.0 ? foot : nearest, polygon.radius};
}

FieldSample sample(const Sphere& sphere, const Vec3& p) {
  const Vec3 d = p - sphere.center;
  const double influence_squared = 4 * sphere.radius * sphere.radius;
  const double v = glm::dot(d, d) / influence_squared;
  return {falloff(v), falloff_slope(v) * 2.0 / influence_squared * d};
}

FadedConeFrame::FadedConeFrame(const FadedCone& cone)
    : axis((cone.tip - cone.base) / glm::distance(cone.tip, cone.base)),
      length(glm::distance(cone.tip, cone.base)),
      taper((cone.tip_radius - cone.base_radius) / length),
      lowest_radius(0.5 * std::min(cone.base_radius, cone.tip_radius)),
      highest_radius(2.0 * std::max(cone.base_radius, cone.tip_radius)) {
  // step(y; R, r) = S((y - (R - 2 r)) / (3 r)). A free base is at full strength from -infinity on, a free tip never
  // falls.
  const bool joined_base = cone.parent_radius > 0;
  const bool joined_tip = cone.child_radius > 0;
  free_axis = {joined_base ? -kInfinity : 0.0, joined_tip ? kInfinity : length};
  rise_start = joined_base ? cone.parent_radius - 2 * cone.base_radius : -kInfinity;
  rise_length = joined_base ? 3 * cone.base_radius : 1.0;
  fall_start = joined_tip ? length + cone.tip_radius - 2 * cone.child_radius : kInfinity;
  fall_length = joined_tip ? 3 * cone.child_radius : 1.0;
}

FieldSample sample(const FadedCone& cone, const Vec3& p) {
  const FadedConeFrame frame(cone);
  const double s = frame.taper;
  const double y = glm::dot(p - cone.base, frame.axis);
  const Vec3 beside = across(p - cone.base, frame.axis);
  const double rho2 = glm::dot(beside, beside);

  const double rise_at = (y - frame.rise_start) / frame.rise_length;
  const double fall_at = (y - frame.fall_start) / frame.fall_length;
  const double weight = std::max(0.0, fade(rise_at) - fade(fall_at));
  const double weight_slope =
      weight > 0 ? fade_slope(rise_at) / frame.rise_length - fade_slope(fall_at) / frame.fall_length : 0.0;

  // The nearest sphere of the endless cone, and how it moves with y and rho^2. Where nothing is clamped the movement
  // cancels out of the gradient (envelope theorem); where a radius is clamped it does not.
  const double foot = cone.base_radius + s * y;
  const double rc = std::max(foot, frame.lowest_radius);
  const double best = y + s * rho2 / rc;
  const double center = std::clamp(best, frame.free_axis.lo, frame.free_axis.hi);
  const double moves = center == best ? 1.0 : 0.0;
  const double center_by_y = moves * (foot > frame.lowest_radius ? 1.0 - s * s * rho2 / (rc * rc) : 1.0);
  const double center_by_rho2 = moves * s / rc;
  const double tapered = cone.base_radius + s * center;
  const double radius = std::clamp(tapered, frame.lowest_radius, frame.highest_radius);
  const double radius_slope = radius == tapered ? s : 0.0;

  const double dy = y - center;
  const double influence2 = 4 * radius * radius;
  const double v = (dy * dy + rho2) / influence2;
  const double v_by_center = (-2 * dy - v * 8 * radius * radius_slope) / influence2;
  const double v_by_y = 2 * dy / influence2 + v_by_center * center_by_y;
  const double v_by_rho2 = 1 / influence2 + v_by_center * center_by_rho2;

  const double g = falloff(v);
  const Vec3 v_gradient = v_by_y * frame.axis + 2 * v_by_rho2 * beside;
  return {weight * g, weight * falloff_slope(v) * v_gradient + g * weight_slope * frame.axis};
}

}  // namespace barkridge
