#include "blobtree/field.h"

#include <vector>

namespace barkridge {

void Field::values_along(const Ray& ray, const Interval& range, std::span<double> values) const {
  thread_local std::vector<Vec3> points;
  points.resize(values.size());
  const double step = (range.hi - range.lo) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = ray.at(range.lo + static_cast<double>(i) * step);
  this->values(points, values);
}

}  // namespace barkridge
