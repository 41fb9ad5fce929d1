#pragma once
// Where a primitive's field is non-zero, and what it can be on a box. [docs/field.md, "Bounds"]

#include "blobtree/field.h"
#include "blobtree/primitive.h"
#include "blobtree/tree.h"

namespace barkridge {

/// The box around a disc across a unit vector.
Box disc_box(const Vec3& center, const Vec3& axis, double radius);

Box support_of(const Cone& cone);
Box support_of(const FadedCone& cone);
Box support_of(const Disc& disc);
Box support_of(const Ring& ring);
Box support_of(const Polygon& polygon);

/// Bounds of a primitive on a box from those on the part inside the primitive's support, which `of_part` computes:
/// outside it the field is zero.
template <typename OfPart>
FieldBounds bounds_where_supported(const Box& support, const Box& box, OfPart of_part) {
  const Box part = intersect(support, box);
  if (part.empty()) return {};
  FieldBounds bounds = of_part(part);
  if (part.lo != box.lo || part.hi != box.hi) bounds.value.lo = 0;
  return bounds;
}

/// Bounds of the falloff for normalised distances in a range of which `lo` is less than 1, and of which the slope is at
/// most the given one; the second form is for those over a box of the given half diagonal, for a normalised distance
/// that is `u` at its centre, has at most the given slope throughout, and is off by rounding up to a share of itself.
FieldBounds falloff_bounds_between(const Interval& u, double slope);
FieldBounds falloff_bounds(double u, double slope, double half_diagonal, double rounding);

/// Conservative, and exact to first order in the box's size. Those of cones are in blobtree/cone_record.h.
FieldBounds bounds_of(const Disc& disc, const Box& box);
FieldBounds bounds_of(const Ring& ring, const Box& box);
FieldBounds bounds_of(const Polygon& polygon, const Box& box);

}  // namespace barkridge
