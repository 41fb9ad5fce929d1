#pragma once
// The first point of a solid along a piece of a ray, found by bounds and not by hope.

#include <optional>

#include "blobtree/field.h"

namespace barkridge {

/// The part of `range` in which the ray is inside the closed box; empty when there is none. Boxes that share a face get
/// intervals that share an end, so no gap opens between them.
Interval clip(const Ray& ray, const Box& box, Interval range);

/// A field along the part of a ray inside a box. Points are kept inside the box against rounding, so a field that is
/// restricted to the box is never asked elsewhere.
struct FieldAlongRay {
  const Field& field;
  const Ray& ray;
  const Box& box;

  Vec3 at(double t) const { return glm::clamp(ray.at(t), box.lo, box.hi); }
  double value(double t) const;
  /// Bounds over the box of the piece between two parameters.
  FieldBounds bounds(double from, double to) const;
};

/// The smallest t in `range` with F >= kIsoValue, or none. Nothing is missed that is thicker than `tolerance` along the
/// ray; t is exact to rounding where the field crosses the iso-value at an angle, and to `tolerance` always.
///
/// The ray advances by (iso - F) / slope, the slope bounded over the piece ahead only, and passes pieces whole whose
/// values stay below the iso-value [Galin et al. 2020, "Segment Tracing Using Local Lipschitz Bounds"]. Longer steps
/// are tried where the field's trend allows them and kept when the clear stretches of both their ends meet [Keinert et
/// al. 2014, "Enhanced Sphere Tracing"].
std::optional<double> first_inside(const FieldAlongRay& along, Interval range, double tolerance);

/// Whether any t in `range` has F >= kIsoValue, by the same rules; stops at the first such t it meets.
bool any_inside(const FieldAlongRay& along, Interval range, double tolerance);

}  // namespace barkridge
