#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "blobtree/field.h"

namespace barkridge::test {

/// A field given by its values at the points of a lattice with cells of size 1, from the origin on, trilinear between
/// them. The outermost values must be zero.
class LatticeField : public Field {
 public:
  explicit LatticeField(const glm::ivec3& size)
      : size_(size),
        values_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                static_cast<std::size_t>(size.z)) {}

  glm::ivec3 size() const { return size_; }
  float& at(const glm::ivec3& i) { return values_[index(i)]; }
  float at(const glm::ivec3& i) const { return values_[index(i)]; }

  Box support() const override { return {Vec3(0), Vec3(size_ - 1)}; }
  void values(std::span<const Vec3> points, std::span<double> values) const override {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = interpolate(points[i], nullptr);
  }
  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = interpolate(points[i], &gradients[i]);
  }
  FieldBounds bounds(const Box& box) const override {
    const glm::ivec3 lo = glm::clamp(glm::ivec3(glm::floor(box.lo)), glm::ivec3(0), size_ - 1);
    const glm::ivec3 hi = glm::clamp(glm::ivec3(glm::ceil(box.hi)), glm::ivec3(0), size_ - 1);
    const glm::ivec3 extent = hi - lo;
    if (extent.x > 32 || extent.y > 32 || extent.z > 32) return {{0, 1}, 2};
    Interval value{0, 0};
    if (support().contains(box.lo) && support().contains(box.hi)) value = {};
    for (int z = lo.z; z <= hi.z; ++z) {
      for (int y = lo.y; y <= hi.y; ++y) {
        for (int x = lo.x; x <= hi.x; ++x) {
          const double v = at({x, y, z});
          value = {std::min(value.lo, v), std::max(value.hi, v)};
        }
      }
    }
    return {value, 2};
  }
  std::shared_ptr<const Field> restricted(const Box&) const override {
    return std::shared_ptr<const Field>(std::shared_ptr<void>(), this);
  }
  std::size_t primitive_count() const override { return values_.size(); }

 private:
  std::size_t index(const glm::ivec3& i) const {
    return (static_cast<std::size_t>(i.z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(i.y)) *
               static_cast<std::size_t>(size_.x) +
           static_cast<std::size_t>(i.x);
  }

  double interpolate(const Vec3& p, Vec3* gradient) const {
    if (gradient != nullptr) *gradient = Vec3(0);
    if (!support().contains(p)) return 0;
    const glm::ivec3 cell = glm::min(glm::ivec3(glm::floor(p)), size_ - 2);
    const Vec3 t = p - Vec3(cell);
    double value = 0;
    for (int c = 0; c < 8; ++c) {
      const glm::ivec3 corner(c & 1, c >> 1 & 1, c >> 2);
      const double v = at(cell + corner);
      Vec3 weight;
      for (int axis = 0; axis < 3; ++axis) weight[axis] = corner[axis] != 0 ? t[axis] : 1 - t[axis];
      value += v * weight.x * weight.y * weight.z;
      if (gradient == nullptr) continue;
      const Vec3 sign = 2.0 * Vec3(corner) - 1.0;
      *gradient += v * sign * Vec3(weight.y * weight.z, weight.x * weight.z, weight.x * weight.y);
    }
    return value;
  }

  glm::ivec3 size_;
  std::vector<float> values_;
};

}  // namespace barkridge::test
