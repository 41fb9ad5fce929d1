#include "blobtree/primitive_bounds.h"

#include <algorithm>
#include <cmath>

#include "blobtree/falloff.h"

namespace barkridge {

namespace {

// Bounds must hold for what rounding makes of the exact formulas.
constexpr double kRounding = 1e-12;

Box ball(const Vec3& center, double radius) { return {center - Vec3(radius), center + Vec3(radius)}; }

// The box of a disc of `radius` across `axis`.
Box disc_box(const Vec3& center, const Vec3& axis, double radius) {
  const Vec3 extent = radius * glm::sqrt(glm::max(Vec3(0), Vec3(1) - axis * axis));
  return {center - extent, center + extent};
}

// Falloff bounds for a normalised distance that is `u` at the box's centre and has the given slope throughout.
FieldBounds bounds_from_distance(double u, double slope, const Box& box) {
  const double reach = slope * glm::length(box.half_extent());
  const double rounding = kRounding * (1 + u);
  const Interval range{std::max(0.0, u - reach - rounding), u + reach + rounding};
  if (range.lo >= 1) return {};
  const double hi = std::min(1.0, range.hi);
  return {{falloff(hi * hi), falloff(range.lo * range.lo)}, steepest_falloff({range.lo, hi}) * slope};
}

template <typename Primitive>
FieldBounds bounds_of_constant_radius(const Primitive& primitive, const Box& box) {
  const Sphere sphere = nearest_sphere(primitive, box.center());
  const double slope = 1 / (2 * sphere.radius);
  return bounds_from_distance(glm::distance(box.center(), sphere.center) * slope, slope, box);
}

// What one of a faded cone's steps along its axis can be.
struct FadeRange {
  Interval value;
  double slope = 0;
};

FadeRange fade_range(const Interval& y, double start, double length) {
  // Most of a tree is outside the windows.
  if (y.lo >= start + length) return {{1, 1}, 0};
  if (y.hi <= start) return {{0, 0}, 0};
  const Interval t{(y.lo - start) / length, (y.hi - start) / length};
  const double steepest = t.contains(0.5) ? kSteepestFade : std::max(fade_slope(t.lo), fade_slope(t.hi));
  return {{fade(t.lo), fade(t.hi)}, steepest / length};
}

// A bound of |grad u| over the box, u being the normalised distance of a faded cone. Where no radius is clamped, u
// grows by 1 / (2 r) a length. The derivatives of the clamped formulas, with k = (s rho / rc)^2, are bounded by the
// rest.
double distance_slope(const FadedCone& cone, const FadedConeFrame& frame, const Interval& y, double highest_rho) {
  const double s = frame.taper;
  const double rho2 = highest_rho * highest_rho;
  const Interval foot{cone.base_radius + std::min(s * y.lo, s * y.hi), cone.base_radius + std::max(s * y.lo, s * y.hi)};
  const double lowest_rc = std::max(foot.lo, frame.lowest_radius);
  const double sweep = s * rho2 / lowest_rc;
  const Interval center{std::clamp(y.lo + std::min(0.0, sweep), frame.free_axis.lo, frame.free_axis.hi),
                        std::clamp(y.hi + std::max(0.0, sweep), frame.free_axis.lo, frame.free_axis.hi)};
  const Interval tapered{cone.base_radius + std::min(s * center.lo, s * center.hi),
                         cone.base_radius + std::max(s * center.lo, s * center.hi)};
  const double lowest = std::clamp(tapered.lo, frame.lowest_radius, frame.highest_radius);
  double slope = 1 / (2 * lowest);
  const bool foot_clamped = foot.lo < frame.lowest_radius;
  const bool radius_clamped = tapered.lo < frame.lowest_radius || tapered.hi > frame.highest_radius;
  if (!foot_clamped && !radius_clamped) return slope;
  const double k = s * s * rho2 / (lowest_rc * lowest_rc);
  if (foot_clamped) {
    const double by_rho = std::max((1 + 2 * k) / (2 * std::sqrt(1 + k)), 2 * s * s * highest_rho / frame.lowest_radius);
    slope = std::max(slope, std::hypot(std::abs(s), by_rho) / lowest);
  }
  if (radius_clamped) {
    slope = std::max(slope, std::hypot(1 + 2 * k, k * std::sqrt(k)) / std::sqrt(1 + k) / (2 * lowest));
  }
  return slope;
}

// The largest distance from the axis at which a faded cone's field can be non-zero between two axial places: that of
// the envelope of the spheres of twice the radius, and never more than the largest radius allows.
double highest_reach(const FadedCone& cone, const FadedConeFrame& frame, const Interval& y) {
  const double limit = 2 * frame.highest_radius;
  const double slope = 2 * std::abs(frame.taper);
  if (slope >= 0.99) return limit;
  const double radius =
      std::max({cone.base_radius + frame.taper * y.lo, cone.base_radius + frame.taper * y.hi, frame.lowest_radius});
  return std::min(limit, 2 * radius / std::sqrt(1 - slope * slope));
}

// Where along the axis a faded cone's field can be non-zero.
Interval axial_support(const FadedCone& cone, const FadedConeFrame& frame) {
  const bool steep = 2 * std::abs(frame.taper) >= 1;
  const double limit = 2 * frame.highest_radius;
  return {cone.parent_radius > 0 ? frame.rise_start : -(steep ? limit : 2 * cone.base_radius),
          cone.child_radius > 0 ? frame.fall_start + frame.fall_length
                                : frame.length + (steep ? limit : 2 * cone.tip_radius)};
}

}  // namespace

Box support_of(const Cone& cone) {
  return unite(ball(cone.base, 2 * cone.base_radius), ball(cone.tip, 2 * cone.tip_radius));
}

Box support_of(const FadedCone& cone) {
  const FadedConeFrame frame(cone);
  const Interval y = axial_support(cone, frame);
  if (y.empty()) return {};
  const double reach = highest_reach(cone, frame, y);
  const Box box = unite(disc_box(cone.base + y.lo * frame.axis, frame.axis, reach),
                        disc_box(cone.base + y.hi * frame.axis, frame.axis, reach));
  return grown(box, kRounding * (reach + frame.length));
}

Box support_of(const Disc& disc) {
  return grown(disc_box(disc.center, glm::normalize(disc.normal), disc.disc_radius), 2 * disc.radius);
}

Box support_of(const Ring& ring) {
  return grown(disc_box(ring.center, glm::normalize(ring.normal), ring.ring_radius), 2 * ring.radius);
}

Box support_of(const Polygon& polygon) {
  Box box;
  for (const Vec3& vertex : polygon.vertices) box = unite(box, vertex);
  return grown(box, 2 * polygon.radius);
}

FieldBounds bounds_of(const Cone& cone, const Box& box) {
  const Vec3 center = box.center();
  const Sphere sphere = nearest_sphere(cone, center);
  const double u = glm::distance(center, sphere.center) / (2 * sphere.radius);
  // grad u has length 1 / (2 r) with r of the nearest sphere, which is somewhere along the axis.
  return bounds_from_distance(u, 1 / (2 * std::min(cone.base_radius, cone.tip_radius)), box);
}

FieldBounds bounds_of(const FadedCone& cone, const FadedConeFrame& frame, const Box& box) {
  const Vec3 from_base = box.center() - cone.base;
  const double y_center = glm::dot(from_base, frame.axis);
  const double y_reach = glm::dot(glm::abs(frame.axis), box.half_extent());
  const double y_rounding = kRounding * (std::abs(y_center) + frame.length);
  const Interval y{y_center - y_reach - y_rounding, y_center + y_reach + y_rounding};
  const FadeRange rise = fade_range(y, frame.rise_start, frame.rise_length);
  const FadeRange fall = fade_range(y, frame.fall_start, frame.fall_length);
  const Interval weight{std::max(0.0, rise.value.lo - fall.value.hi), std::max(0.0, rise.value.hi - fall.value.lo)};
  if (weight.hi <= 0) return {};

  const Vec3 beside = from_base - y_center * frame.axis;
  const double rho2 = glm::dot(beside, beside);
  const double highest_rho = std::sqrt(rho2) + glm::length(box.half_extent());
  const double rc = std::max(cone.base_radius + frame.taper * y_center, frame.lowest_radius);
  const double center = std::clamp(y_center + frame.taper * rho2 / rc, frame.free_axis.lo, frame.free_axis.hi);
  const double radius = std::clamp(cone.base_radius + frame.taper * center, frame.lowest_radius, frame.highest_radius);
  const double u = std::sqrt((y_center - center) * (y_center - center) + rho2) / (2 * radius);
  const FieldBounds g = bounds_from_distance(u, distance_slope(cone, frame, y, highest_rho), box);
  if (g.value.hi <= 0) return {};
  const double weight_slope = std::max(rise.slope, fall.slope);
  return {{weight.lo * g.value.lo, weight.hi * g.value.hi}, weight.hi * g.slope + g.value.hi * weight_slope};
}

FieldBounds bounds_of(const Disc& disc, const Box& box) { return bounds_of_constant_radius(disc, box); }
FieldBounds bounds_of(const Ring& ring, const Box& box) { return bounds_of_constant_radius(ring, box); }
FieldBounds bounds_of(const Polygon& polygon, const Box& box) { return bounds_of_constant_radius(polygon, box); }

}  // namespace barkridge
