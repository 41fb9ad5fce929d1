#pragma once
// What a caliper, a goniometer and a straightedge would say of a surface: lengths and angles found from the field's
// values by steps and halvings along rays, without bounds or cells.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "blobtree/field.h"
#include "lsystem/skeleton.h"
#include "tests/support/degree.h"

namespace barkridge::test {

inline bool is_inside(const Field& field, const Vec3& p) {
  double value = 0;
  field.values({&p, 1}, {&value, 1});
  return value >= kIsoValue;
}

/// The first point of the solid along a ray, to the last digit, if there is one within `length`. What lies between two
/// points a `step` apart and touches neither is overlooked. 0 where the ray starts inside.
inline std::optional<double> first_inside(const Field& field, const Ray& ray, double length, double step = 0.01) {
  if (is_inside(field, ray.origin)) return 0;
  for (double outside = 0; outside < length; outside += step) {
    double inside = outside + step;
    if (!is_inside(field, ray.at(inside))) continue;
    for (int i = 0; i < 55; ++i) {
      const double middle = 0.5 * (outside + inside);
      (is_inside(field, ray.at(middle)) ? inside : outside) = middle;
    }
    return inside;
  }
  return std::nullopt;
}

/// Distance from `axis_point` to the outermost surface along the unit vector `direction`, sought from `farthest`
/// inwards; 0 if there is none.
inline double surface_radius(const Field& field, const Vec3& axis_point, const Vec3& direction, double farthest) {
  const auto found = first_inside(field, {axis_point + farthest * direction, -direction}, farthest);
  return found ? farthest - *found : 0;
}

/// Surface and outward normal where a ray meets the solid from outside.
struct SurfacePoint {
  Vec3 position{0}, normal{0};
};
inline std::optional<SurfacePoint> surface_point(const Field& field, const Ray& ray, double length,
                                                 double step = 0.01) {
  const auto found = first_inside(field, ray, length, step);
  if (!found || *found == 0) return std::nullopt;
  SurfacePoint point{ray.at(*found), Vec3(0)};
  double value = 0;
  field.values_and_gradients({&point.position, 1}, {&value, 1}, {&point.normal, 1});
  point.normal = -glm::normalize(point.normal);
  return point;
}

/// A family of rays over [0, 1].
using RayFan = std::function<Ray(double)>;

/// The angle outside between the two walls where the surface that a fan of rays sees turns most sharply inwards, in
/// degrees: 180 where it is smooth, 0 where the walls touch. Where one wall hides the bottom, the angle is that of the
/// hiding edge and what it hides. The fan is looked at in `rays` places, and the sharpest turn is narrowed down to 1e-9
/// of it. Rays that start inside or see nothing within `length` do not count.
inline double sharpest_opening_degrees(const Field& field, const RayFan& fan, double length, double step,
                                       int rays = 200) {
  using Sample = std::optional<SurfacePoint>;
  const auto look = [&](double t) { return surface_point(field, fan(t), length, step); };
  const auto turn = [](const Sample& a, const Sample& b) {
    // Walls that face each other; a convex edge turns the other way.
    const bool concave = a && b && glm::dot(b->position - a->position, a->normal - b->normal) > 0;
    return concave ? std::acos(std::clamp(glm::dot(a->normal, b->normal), -1.0, 1.0)) : 0.0;
  };
  std::vector<Sample> samples;
  for (int i = 0; i <= rays; ++i) samples.push_back(look(static_cast<double>(i) / rays));
  double sharpest = 0, lo = 0;
  for (int i = 0; i < rays; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double angle = turn(samples[k], samples[k + 1]);
    if (angle <= sharpest) continue;
    sharpest = angle;
    lo = static_cast<double>(i) / rays;
  }
  double hi = lo + 1.0 / rays;
  Sample left = look(lo), right = look(hi);
  while (hi - lo > 1e-9) {
    const double middle = 0.5 * (lo + hi);
    const Sample between = look(middle);
    const bool in_left = turn(left, between) > turn(between, right);
    (in_left ? hi : lo) = middle;
    (in_left ? right : left) = between;
  }
  return 180 - turn(left, right) / kDegree;
}

/// The same angle at a given point of a crease: of the largest turn between gradients on a circle of radius 1e-6 around
/// it, in the plane of the unit vectors `a` and `b`, which the crease crosses.
inline double opening_degrees_at(const Field& field, const Vec3& crease, const Vec3& a, const Vec3& b) {
  constexpr int kPoints = 24;
  std::vector<Vec3> points, gradients(kPoints);
  std::vector<double> values(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 360.0 * i / kPoints * kDegree;
    points.push_back(crease + 1e-6 * (std::cos(angle) * a + std::sin(angle) * b));
  }
  field.values_and_gradients(points, values, gradients);
  double least_cosine = 1;
  for (const Vec3& one : gradients) {
    for (const Vec3& other : gradients) {
      least_cosine = std::min(least_cosine, glm::dot(glm::normalize(one), glm::normalize(other)));
    }
  }
  return std::max(0.0, 180 - std::acos(std::max(-1.0, least_cosine)) / kDegree);
}

/// How far a point is outside the union of a skeleton's internodes as they would be without blend, contact or joint;
/// negative inside. Of internodes with one radius; for tapered ones the distance to the nearest sphere along the foot
/// of the perpendicular.
inline double rise_above_union(const Skeleton& skeleton, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Internode& a : skeleton.internodes) {
    const Vec3 axis = a.tip - a.base;
    const double t = std::clamp(glm::dot(p - a.base, axis) / glm::dot(axis, axis), 0.0, 1.0);
    least = std::min(least, glm::distance(p, a.base + t * axis) - (a.base_radius + t * (a.tip_radius - a.base_radius)));
  }
  return least;
}

}  // namespace barkridge::test
