#pragma once
// Discs and rings at many points at once, for the instruction set that the machine has.

#include "blobtree/cone_kernels.h"
#include "blobtree/tree.h"

namespace barkridge {

/// A disc or a ring, as both are about a circle.
struct RoundShape {
  Vec3 center, normal;  ///< normal of any length
  double circle_radius, radius;
  bool is_filled;

  RoundShape(const Disc& d)
      : center(d.center), normal(d.normal), circle_radius(d.disc_radius), radius(d.radius), is_filled(true) {}
  RoundShape(const Ring& r)
      : center(r.center), normal(r.normal), circle_radius(r.ring_radius), radius(r.radius), is_filled(false) {}
};

/// Its field, in single precision like the cones.
void sample_round(const RoundShape& shape, double scale, const PointBatch& points, const FieldColumns& out);

}  // namespace barkridge
