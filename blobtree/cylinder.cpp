#include "blobtree/cylinder.h"

#include <cmath>

#include "blobtree/primitive_bounds.h"

namespace barkridge {

Cylinder cylinder_around(const Box& box) {
  const Vec3 half = box.half_extent();
  return {box.center(), {1, 0, 0}, half.x, std::hypot(half.y, half.z)};
}

Box box_around(const Cylinder& c) {
  const Vec3 end = c.half_length * c.axis;
  return unite(disc_box(c.center - end, c.axis, c.radius), disc_box(c.center + end, c.axis, c.radius));
}

// The distance of two segments [Ericson 2005, "Real-Time Collision Detection", section 5.1.9].
bool may_overlap(const Cylinder& a, const Cylinder& b) {
  const Vec3 between = a.center - b.center;
  const double reach = a.radius + b.radius, far = reach + a.half_length + b.half_length;
  const double distance2 = glm::dot(between, between);
  if (distance2 > far * far) return false;
  const double cosine = glm::dot(a.axis, b.axis), along_a = glm::dot(a.axis, between),
               along_b = glm::dot(b.axis, between);
  // Axes are known to single precision: where they are nearly parallel, the nearest places are not.
  constexpr double kParallel = 1e-6;
  const double sine2 = 1 - cosine * cosine;
  double s = sine2 > kParallel ? std::clamp((cosine * along_b - along_a) / sine2, -a.half_length, a.half_length) : 0;
  double t = cosine * s + along_b;
  if (std::abs(t) > b.half_length) {
    t = std::copysign(b.half_length, t);
    s = std::clamp(cosine * t - along_a, -a.half_length, a.half_length);
  }
  const Vec3 way = between + s * a.axis - t * b.axis;
  const double off = 2e-3 * std::min(a.half_length, b.half_length);
  const double enough = sine2 > kParallel ? reach * (1 + 1e-6) : reach + off;
  return glm::dot(way, way) <= enough * enough;
}

}  // namespace barkridge
