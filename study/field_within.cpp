#include "study/field_within.h"

#include <algorithm>

namespace barkridge {

namespace {

bool is_inside(const Box& inner, const Box& outer) { return outer.contains(inner.lo) && outer.contains(inner.hi); }

}  // namespace

FieldWithin::FieldWithin(std::shared_ptr<const Field> whole, const Box& box) : whole_(std::move(whole)), box_(box) {}

Box FieldWithin::support() const { return intersect(whole_->support(), box_); }

void FieldWithin::values(std::span<const Vec3> points, std::span<double> values) const {
  whole_->values(points, values);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!box_.contains(points[i])) values[i] = 0;
  }
}

void FieldWithin::values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                                       std::span<Vec3> gradients) const {
  whole_->values_and_gradients(points, values, gradients);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (box_.contains(points[i])) continue;
    values[i] = 0;
    gradients[i] = Vec3(0);
  }
}

FieldBounds FieldWithin::bounds(const Box& box) const {
  if (is_inside(box, box_)) return whole_->bounds(box);
  if (!box.overlaps(box_)) return {};
  // Some of it lies on either side of the jump.
  const Interval value = whole_->bounds(box).value;
  FieldBounds bounds;
  bounds.value = {std::min(value.lo, 0.0), std::max(value.hi, 0.0)};
  bounds.slope = std::numeric_limits<double>::infinity();
  return bounds;
}

std::shared_ptr<const Field> FieldWithin::restricted(const Box& box) const {
  if (is_inside(box, box_)) return whole_->restricted(box);
  return std::make_shared<FieldWithin>(whole_->restricted(box), box_);
}

std::unique_ptr<const SurfaceCells> FieldWithin::cells() const { return whole_->restricted(box_)->cells(); }

std::size_t FieldWithin::primitive_count() const { return whole_->primitive_count(); }

}  // namespace barkridge
