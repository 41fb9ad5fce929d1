#include "blobtree/field.h"

#include <algorithm>
#include <array>
#include <optional>

#include "blobtree/ray_search.h"

namespace barkridge {

namespace {

std::optional<double> search(const Field& field, const Ray& ray, const Interval& range, double tolerance,
                             SearchAim aim) {
  const Vec3 a = ray.at(range.lo), b = ray.at(range.hi);
  const FieldBounds bounds = field.bounds({glm::min(a, b), glm::max(a, b)});
  if (bounds.value.hi < kIsoValue) return std::nullopt;
  // Halved until the field varies little enough for samples to tell something.
  constexpr double kMostVariation = 8;
  const double length = range.hi - range.lo, middle = 0.5 * (range.lo + range.hi);
  if (bounds.slope * length > kMostVariation && length > 2 * tolerance) {
    const std::optional<double> first = search(field, ray, {range.lo, middle}, tolerance, aim);
    return first ? first : search(field, ray, {middle, range.hi}, tolerance, aim);
  }
  const auto sample = [&](const Interval& part, std::array<double, 16>& values) {
    std::array<Vec3, 16> points;
    const double step = (part.hi - part.lo) / static_cast<double>(points.size() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = ray.at(part.lo + static_cast<double>(i) * step);
    field.values(points, values);
  };
  const std::optional<RayRoot> root = RaySearch<double, decltype(sample)>(sample, bounds, tolerance, aim).run(range);
  return root ? std::optional(root->t) : std::nullopt;
}

// The whole support as one cell.
class SingleCell final : public SurfaceCells {
 public:
  explicit SingleCell(std::shared_ptr<const Field> field) : field_(std::move(field)), box_(field_->support()) {}

  std::size_t size() const override { return box_.empty() ? 0 : 1; }
  Box box(std::size_t) const override { return box_; }

  RayLanes first_inside(std::size_t, const RayBundle& bundle, RayLanes rays, const RayRanges::Column&, double tolerance,
                        std::array<SurfacePoint, RayBundle::kWidth>& found) const override {
    RayLanes hits = 0;
    for_each_lane(rays, [&](std::size_t lane) {
      const std::optional<double> t = search_part(bundle, lane, tolerance, SearchAim::kFirstPoint);
      if (!t) return;
      const Vec3 point = bundle.ray(lane).at(*t);
      double value = 0;
      Vec3 gradient{0};
      field_->values_and_gradients({&point, 1}, {&value, 1}, {&gradient, 1});
      found[lane] = {*t, gradient};
      hits |= RayLanes{1} << lane;
    });
    return hits;
  }
  RayLanes any_inside(std::size_t, const RayBundle& bundle, RayLanes rays, double tolerance) const override {
    RayLanes hits = 0;
    for_each_lane(rays, [&](std::size_t lane) {
      if (search_part(bundle, lane, tolerance, SearchAim::kAnyPoint)) hits |= RayLanes{1} << lane;
    });
    return hits;
  }

 private:
  std::optional<double> search_part(const RayBundle& bundle, std::size_t lane, double tolerance, SearchAim aim) const {
    const Ray ray = bundle.ray(lane);
    const Interval part = clip(ray, box_, bundle.ranges[lane]);
    return part.empty() ? std::nullopt : search(*field_, ray, part, tolerance, aim);
  }

  std::shared_ptr<const Field> field_;
  Box box_;
};

}  // namespace

std::unique_ptr<const SurfaceCells> Field::cells() const { return std::make_unique<SingleCell>(restricted(support())); }

}  // namespace barkridge
