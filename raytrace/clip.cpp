#include "raytrace/clip.h"

namespace barkridge {

Interval clip(const Ray& ray, const Box& box, Interval range) {
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis], direction = ray.direction[axis];
    if (direction == 0) {
      if (origin < box.lo[axis] || origin > box.hi[axis]) return {};
      continue;
    }
    const double a = (box.lo[axis] - origin) / direction;
    const double b = (box.hi[axis] - origin) / direction;
    range.lo = std::max(range.lo, std::min(a, b));
    range.hi = std::min(range.hi, std::max(a, b));
  }
  return range;
}

}  // namespace barkridge
