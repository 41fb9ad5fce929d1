#include "blobtree/primitive_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blobtree/falloff.h"

namespace barkridge {

namespace {

// Bounds must hold for what rounding makes of the exact formulas.
constexpr double kRounding = 1e-12;

Box ball(const Vec3& center, double radius) { return {center - Vec3(radius), center + Vec3(radius)}; }

template <typename Primitive>
FieldBounds bounds_of_constant_radius(const Primitive& primitive, const Box& box) {
  const Sphere sphere = nearest_sphere(primitive, box.center());
  const double slope = 1 / (2 * sphere.radius);
  const double u = glm::distance(box.center(), sphere.center) * slope;
  return falloff_bounds(u, slope, glm::length(box.half_extent()), kRounding);
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

Box disc_box(const Vec3& center, const Vec3& axis, double radius) {
  const Vec3 extent = radius * glm::sqrt(glm::max(Vec3(0), Vec3(1) - axis * axis));
  return {center - extent, center + extent};
}

FieldBounds falloff_bounds_between(const Interval& u, double slope) {
  const double hi = std::min(1.0, u.hi);
  const Interval second = falloff_second(u.lo);
  return {{falloff(hi * hi), falloff(u.lo * u.lo)},
          steepest_falloff({u.lo, hi}) * slope,
          {second.lo * slope * slope, second.hi * slope * slope}};
}

FieldBounds falloff_bounds(double u, double slope, double half_diagonal, double rounding) {
  const double reach = slope * half_diagonal + rounding * (1 + u);
  const Interval range{std::max(0.0, u - reach), u + reach};
  return range.lo >= 1 ? FieldBounds{} : falloff_bounds_between(range, slope);
}

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

namespace {

// Where two places of a shape are equally near, as on the axis of a ring, its field has a crease that points up. Of a
// convex shape that is nowhere outside.
FieldBounds with_creases(FieldBounds bounds) {
  bounds.second.hi = std::numeric_limits<double>::infinity();
  return bounds;
}

}  // namespace

FieldBounds bounds_of(const Disc& disc, const Box& box) { return bounds_of_constant_radius(disc, box); }
FieldBounds bounds_of(const Ring& ring, const Box& box) { return with_creases(bounds_of_constant_radius(ring, box)); }
FieldBounds bounds_of(const Polygon& polygon, const Box& box) {
  return with_creases(bounds_of_constant_radius(polygon, box));
}

}  // namespace barkridge
