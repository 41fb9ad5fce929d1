#include "blobtree/field.h"

#include <vector>

#include "blobtree/ray_search.h"

namespace barkridge {

namespace {

std::optional<double> search(const Field& field, const Ray& ray, const Interval& range, double tolerance, bool any) {
  const Vec3 a = ray.at(range.lo), b = ray.at(range.hi);
  const FieldBounds bounds = field.bounds({glm::min(a, b), glm::max(a, b)});
  if (bounds.value.hi < kIsoValue) return std::nullopt;
  // Halved until the field varies little enough for samples to tell something.
  constexpr double kMostVariation = 8;
  const double length = range.hi - range.lo, middle = 0.5 * (range.lo + range.hi);
  if (bounds.slope * length > kMostVariation && length > 2 * tolerance) {
    const std::optional<double> first = search(field, ray, {range.lo, middle}, tolerance, any);
    return first ? first : search(field, ray, {middle, range.hi}, tolerance, any);
  }
  std::vector<Vec3> points;
  const auto sample = [&](const Interval& part, std::span<double, 16> values) {
    points.clear();
    const double step = (part.hi - part.lo) / static_cast<double>(values.size() - 1);
    for (std::size_t i = 0; i < values.size(); ++i) points.push_back(ray.at(part.lo + static_cast<double>(i) * step));
    field.values(points, values);
  };
  return RaySearch(sample, bounds, tolerance, any).run(range);
}

}  // namespace

std::vector<Box> Field::cover() const { return support().empty() ? std::vector<Box>{} : std::vector<Box>{support()}; }

std::optional<double> Field::first_inside(const Ray& ray, const Interval& range, double tolerance) const {
  return search(*this, ray, range, tolerance, false);
}

bool Field::any_inside(const Ray& ray, const Interval& range, double tolerance) const {
  return search(*this, ray, range, tolerance, true).has_value();
}

}  // namespace barkridge
