#pragma once
// Small fields with known surfaces, bounded and pruned like real ones, for tests of the ray tracer.

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "blobtree/field.h"

namespace barkridge::test {

/// Wyvill's falloff and its derivative by the distance over the influence radius.
inline double falloff(double x) {
  const double v = x * x, t = std::max(0.0, 1 - v);
  return t * t * (1 - 4 * v / 9);
}
inline double falloff_slope(double x) { return x < 1 ? x * (-44.0 / 9 + x * x * (68.0 / 9 - x * x * 24.0 / 9)) : 0.0; }
/// The largest |falloff'| between two arguments; it rises up to x = 0.5035 and falls from there.
inline double steepest_falloff(double near, double far) {
  const double peak = 0.50349;
  if (near <= peak && peak <= far) return 1.58341;
  return std::max(std::abs(falloff_slope(near)), std::abs(falloff_slope(far)));
}

/// One point at a time, which is all that a test needs.
class PointField : public Field, public std::enable_shared_from_this<PointField> {
 public:
  virtual std::pair<double, Vec3> at(const Vec3& p) const = 0;

  void values(std::span<const Vec3> points, std::span<double> values) const override {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = at(points[i]).first;
  }
  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override {
    for (std::size_t i = 0; i < points.size(); ++i) std::tie(values[i], gradients[i]) = at(points[i]);
  }
  std::shared_ptr<const Field> restricted(const Box&) const override { return shared_from_this(); }
  std::size_t primitive_count() const override { return 1; }
};
using FieldPtr = std::shared_ptr<const Field>;

/// The surface is the sphere of that radius.
class Ball : public PointField {
 public:
  Ball(const Vec3& center, double radius) : center_(center), radius_(radius) {}

  Box support() const override { return {center_ - Vec3(2 * radius_), center_ + Vec3(2 * radius_)}; }
  std::pair<double, Vec3> at(const Vec3& p) const override {
    const double d = glm::length(p - center_), x = d / (2 * radius_);
    return {falloff(x), d > 0 ? (p - center_) * (falloff_slope(x) / (2 * radius_ * d)) : Vec3(0)};
  }
  FieldBounds bounds(const Box& box) const override {
    const Vec3 nearest = glm::clamp(center_, box.lo, box.hi) - center_;
    const Vec3 farthest = glm::max(glm::abs(box.lo - center_), glm::abs(box.hi - center_));
    const double near = glm::length(nearest) / (2 * radius_), far = glm::length(farthest) / (2 * radius_);
    const double rounding = 1e-15;
    return {{falloff(far) - rounding, falloff(near) + rounding}, steepest_falloff(near, far) / (2 * radius_)};
  }

 private:
  Vec3 center_;
  double radius_;
};

/// The surface is the torus about the vertical through `center`.
class Torus : public PointField {
 public:
  Torus(const Vec3& center, double ring_radius, double radius)
      : center_(center), ring_radius_(ring_radius), radius_(radius) {}

  Box support() const override {
    const Vec3 half(ring_radius_ + 2 * radius_, 2 * radius_, ring_radius_ + 2 * radius_);
    return {center_ - half, center_ + half};
  }
  std::pair<double, Vec3> at(const Vec3& p) const override {
    const Vec3 q = nearest_to(p);
    const double d = glm::length(p - q), x = d / (2 * radius_);
    return {falloff(x), d > 0 ? (p - q) * (falloff_slope(x) / (2 * radius_ * d)) : Vec3(0)};
  }
  FieldBounds bounds(const Box& box) const override {
    const double d = glm::length(box.center() - nearest_to(box.center())), reach = 0.5 * box.diagonal();
    const double near = std::max(0.0, d - reach) / (2 * radius_), far = (d + reach) / (2 * radius_);
    const double rounding = 1e-15;
    return {{falloff(far) - rounding, falloff(near) + rounding}, steepest_falloff(near, far) / (2 * radius_)};
  }

 private:
  Vec3 nearest_to(const Vec3& p) const {
    const Vec3 flat(p.x - center_.x, 0, p.z - center_.z);
    const double length = glm::length(flat);
    return center_ + (length > 0 ? flat * (ring_radius_ / length) : Vec3(ring_radius_, 0, 0));
  }

  Vec3 center_;
  double ring_radius_, radius_;
};

/// Sum, largest or smallest of some fields.
class Join : public PointField {
 public:
  enum class Kind { kSum, kMax, kMin };

  Join(Kind kind, std::vector<FieldPtr> parts) : kind_(kind), parts_(std::move(parts)) {}

  Box support() const override {
    Box box = parts_.empty() ? Box() : parts_[0]->support();
    for (const FieldPtr& part : parts_) {
      box = kind_ == Kind::kMin ? intersect(box, part->support()) : unite(box, part->support());
    }
    return box;
  }
  std::pair<double, Vec3> at(const Vec3& p) const override {
    std::pair<double, Vec3> result{0, Vec3(0)};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      double value = 0;
      Vec3 gradient{0};
      parts_[i]->values_and_gradients({&p, 1}, {&value, 1}, {&gradient, 1});
      if (kind_ == Kind::kSum) {
        result.first += value;
        result.second += gradient;
      } else if (i == 0 || (kind_ == Kind::kMax ? value > result.first : value < result.first)) {
        result = {value, gradient};
      }
    }
    return result;
  }
  FieldBounds bounds(const Box& box) const override {
    FieldBounds result;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const FieldBounds b = parts_[i]->bounds(box);
      if (i == 0) {
        result = b;
      } else if (kind_ == Kind::kSum) {
        result = {{result.value.lo + b.value.lo, result.value.hi + b.value.hi}, result.slope + b.slope};
      } else if (kind_ == Kind::kMax) {
        result = {{std::max(result.value.lo, b.value.lo), std::max(result.value.hi, b.value.hi)},
                  std::max(result.slope, b.slope)};
      } else {
        result = {{std::min(result.value.lo, b.value.lo), std::min(result.value.hi, b.value.hi)},
                  std::max(result.slope, b.slope)};
      }
    }
    return result;
  }
  std::shared_ptr<const Field> restricted(const Box& box) const override {
    std::vector<FieldPtr> kept;
    for (const FieldPtr& part : parts_) {
      if (kind_ == Kind::kMin || part->support().overlaps(box)) kept.push_back(part->restricted(box));
    }
    if (kept.size() == 1) return kept[0];
    return std::make_shared<Join>(kind_, std::move(kept));
  }
  std::size_t primitive_count() const override {
    std::size_t count = 0;
    for (const FieldPtr& part : parts_) count += part->primitive_count();
    return count;
  }

 private:
  Kind kind_;
  std::vector<FieldPtr> parts_;
};

inline FieldPtr ball(const Vec3& center, double radius) { return std::make_shared<Ball>(center, radius); }
inline FieldPtr torus(const Vec3& center, double ring_radius, double radius) {
  return std::make_shared<Torus>(center, ring_radius, radius);
}
inline FieldPtr sum(std::vector<FieldPtr> parts) { return std::make_shared<Join>(Join::Kind::kSum, std::move(parts)); }
inline FieldPtr largest(std::vector<FieldPtr> parts) {
  return std::make_shared<Join>(Join::Kind::kMax, std::move(parts));
}
inline FieldPtr smallest(std::vector<FieldPtr> parts) {
  return std::make_shared<Join>(Join::Kind::kMin, std::move(parts));
}

}  // namespace barkridge::test
