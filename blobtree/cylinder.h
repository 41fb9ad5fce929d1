#pragma once
// Solid cylinders, around parts of branches.

#include "base/geometry.h"

namespace barkridge {

struct Cylinder {
  Vec3 center{0};
  Vec3 axis{1, 0, 0};  ///< of length 1
  double half_length = 0;
  double radius = 0;
};

/// The smallest one along x that holds a box, which is not empty.
Cylinder cylinder_around(const Box& box);
/// The smallest box that holds a cylinder.
Box box_around(const Cylinder& cylinder);

/// False only where two cylinders do not overlap: where their axes stay farther from each other than the sum of the
/// radii.
bool may_overlap(const Cylinder& a, const Cylinder& b);

}  // namespace barkridge
