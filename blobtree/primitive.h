#pragma once
// Primitives, one point at a time, by the plain formulas. [docs/field.md]

#include "blobtree/tree.h"

namespace barkridge {

struct FieldSample {
  double value = 0;
  Vec3 gradient{0};
};

/// The sphere of a primitive's sweep that has the largest field at a point; the field is that sphere's falloff.
struct Sphere {
  Vec3 center{0};
  double radius = 1;
};
Sphere nearest_sphere(const Cone& cone, const Vec3& p);
Sphere nearest_sphere(const Disc& disc, const Vec3& p);
Sphere nearest_sphere(const Ring& ring, const Vec3& p);
Sphere nearest_sphere(const Polygon& polygon, const Vec3& p);

/// The field of a sphere with influence radius twice its own. By the envelope theorem this is also value and gradient
/// of the primitive that the sphere was swept from.
FieldSample sample(const Sphere& sphere, const Vec3& p);

template <typename Primitive>
FieldSample sample(const Primitive& primitive, const Vec3& p) {
  return sample(nearest_sphere(primitive, p), p);
}
FieldSample sample(const FadedCone& cone, const Vec3& p);

/// The numbers of a faded cone that do not depend on the point.
struct FadedConeFrame {
  explicit FadedConeFrame(const FadedCone& cone);

  Vec3 axis;
  double length;
  double taper;           ///< growth of the radius per length
  double lowest_radius;   ///< the radius is never taken below half the smaller one
  double highest_radius;  ///< nor above twice the larger one
  Interval free_axis;     ///< axial range of the swept sphere: closed at free ends, open at joints
  /// The weight along the axis is max(0, fade(rise) - fade(fall)), both linear in y: rise = (y - rise_start) /
  /// rise_length.
  double rise_start, rise_length, fall_start, fall_length;
};

}  // namespace barkridge
