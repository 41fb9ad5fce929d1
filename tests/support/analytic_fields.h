#pragma once
// Fields whose surfaces are known from geometry, for tests of all that look at a model through `Field`. They count what
// is asked of them, and when something is asked where a restriction promises nothing.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "base/random.h"
#include "blobtree/field.h"

namespace barkridge::test {

struct ValueAndGradient {
  double value = 0;
  Vec3 gradient{0};
};

using Function = std::function<ValueAndGradient(const Vec3&)>;

/// A function clamped to [0, 1], and cut off to zero outside a box, with a Lipschitz constant.
class AnalyticField : public Field {
 public:
  struct Counts {
    std::atomic<std::size_t> evaluations = 0;
    std::atomic<std::size_t> outside_restriction = 0;  ///< points or boxes not in the box restricted to
  };

  AnalyticField(const Box& support, double slope, Function function)
      : AnalyticField(
            support, slope, std::move(function), std::make_shared<Counts>(),
            Box{Vec3(-std::numeric_limits<double>::infinity()), Vec3(std::numeric_limits<double>::infinity())}) {}

  /// Shared with all restrictions.
  const Counts& counts() const { return *counts_; }

  Box support() const override { return support_; }
  void values(std::span<const Vec3> points, std::span<double> values) const override {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = at(points[i]).value;
  }
  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ValueAndGradient result = at(points[i]);
      values[i] = result.value;
      gradients[i] = result.gradient;
    }
  }
  FieldBounds bounds(const Box& box) const override {
    count_if_outside(domain_.contains(box.lo) && domain_.contains(box.hi));
    if (!box.overlaps(support_)) return {{0, 0}, 0};
    const double reach = slope_ * glm::length(box.half_extent()) + 1e-12;
    const double value = function_(box.center()).value;
    const bool cut_off = !support_.contains(box.lo) || !support_.contains(box.hi);
    const double least = cut_off ? 0 : std::clamp(value - reach, 0.0, 1.0);
    return {{least, std::clamp(value + reach, 0.0, 1.0)}, slope_};
  }
  std::shared_ptr<const Field> restricted(const Box& box) const override {
    count_if_outside(domain_.contains(box.lo) && domain_.contains(box.hi));
    return std::shared_ptr<const Field>(new AnalyticField(support_, slope_, function_, counts_, box));
  }
  std::size_t primitive_count() const override { return support_.empty() ? 0 : 1; }

 private:
  AnalyticField(const Box& support, double slope, Function function, std::shared_ptr<Counts> counts, const Box& domain)
      : support_(support), slope_(slope), function_(std::move(function)), counts_(std::move(counts)), domain_(domain) {}

  ValueAndGradient at(const Vec3& p) const {
    ++counts_->evaluations;
    count_if_outside(domain_.contains(p));
    if (!support_.contains(p)) return {};
    const ValueAndGradient result = function_(p);
    if (result.value <= 0) return {};
    return result.value >= 1 ? ValueAndGradient{1, Vec3(0)} : result;
  }
  void count_if_outside(bool contained) const { counts_->outside_restriction += !contained; }

  Box support_;
  double slope_;
  Function function_;
  std::shared_ptr<Counts> counts_;
  Box domain_;
};

// Signed distances, negative inside, of slope at most 1.

inline Function ball(const Vec3& center, double radius) {
  return [=](const Vec3& p) {
    const double d = glm::length(p - center);
    return ValueAndGradient{d - radius, d > 0 ? (p - center) / d : Vec3(0)};
  };
}

/// Around the y axis, `tube` thick, through the circle of radius `ring`.
inline Function torus(const Vec3& center, double ring, double tube) {
  return [=](const Vec3& world) {
    const Vec3 p = world - center;
    const double rho = std::hypot(p.x, p.z);
    const double d = std::hypot(rho - ring, p.y);
    const double along = rho > 0 ? (rho - ring) / (rho * d) : 0;
    return ValueAndGradient{d - tube, d > 0 ? Vec3(p.x * along, p.y / d, p.z * along) : Vec3(0)};
  };
}

/// The points with `dot(p, normal) <= offset`.
inline Function half_space(const Vec3& normal, double offset) {
  return [=](const Vec3& p) { return ValueAndGradient{glm::dot(p, normal) - offset, normal}; };
}

inline Function gyroid(double period, double thickness) {
  return [=](const Vec3& world) {
    const double k = 2 * M_PI / period;
    const Vec3 p = k * world, s = glm::sin(p), c = glm::cos(p);
    const double g = s.x * c.y + s.y * c.z + s.z * c.x;
    const Vec3 gradient = k * Vec3(c.x * c.y - s.z * s.x, c.y * c.z - s.x * s.y, c.z * c.x - s.y * s.z);
    const double scale = 1 / (2 * k);  // |gradient| <= sqrt(3) k
    return ValueAndGradient{scale * std::abs(g) - thickness, (g < 0 ? -scale : scale) * gradient};
  };
}

inline Function union_of(std::vector<Function> parts) {
  return [=](const Vec3& p) {
    ValueAndGradient best = parts.at(0)(p);
    for (const Function& part : parts) {
      if (const ValueAndGradient x = part(p); x.value < best.value) best = x;
    }
    return best;
  };
}

inline Function intersection_of(std::vector<Function> parts) {
  return [=](const Vec3& p) {
    ValueAndGradient best = parts.at(0)(p);
    for (const Function& part : parts) {
      if (const ValueAndGradient x = part(p); x.value > best.value) best = x;
    }
    return best;
  };
}

inline Function complement_of(Function part) {
  return [=](const Vec3& p) {
    const ValueAndGradient x = part(p);
    return ValueAndGradient{-x.value, -x.gradient};
  };
}

inline Function block(const Box& box) {
  std::vector<Function> sides;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 normal(0);
    normal[axis] = 1;
    sides.push_back(half_space(normal, box.hi[axis]));
    sides.push_back(half_space(-normal, -box.lo[axis]));
  }
  return intersection_of(std::move(sides));
}

/// A field that falls from 1 at `width` inside the surface of a signed distance to 0 at `width` outside, linearly.
/// `around` encloses the solid.
inline AnalyticField solid(const Function& distance, const Box& around, double width = 0.25) {
  return {grown(around, width), 0.5 / width, [=](const Vec3& p) {
            const ValueAndGradient d = distance(p);
            return ValueAndGradient{0.5 - 0.5 * d.value / width, -0.5 / width * d.gradient};
          }};
}

inline Box cube(const Vec3& center, double half_size) { return {center - half_size, center + half_size}; }

inline AnalyticField ball_field(const Vec3& center, double radius, double width = 0.25) {
  return solid(ball(center, radius), cube(center, radius), width);
}

inline AnalyticField torus_field(const Vec3& center, double ring, double tube, double width = 0.25) {
  return solid(torus(center, ring, tube), cube(center, ring + tube), std::min(width, tube));
}

/// Soft balls in the unit cube about the origin, added up: `seed` decides where and how large.
inline AnalyticField blobs_field(std::uint64_t seed, int count, double radius) {
  struct Blob {
    Vec3 center;
    double influence;
  };
  std::vector<Blob> blobs;
  Box support;
  double slope = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 center(random_unit(seed, i, 0) - 0.5, random_unit(seed, i, 1) - 0.5, random_unit(seed, i, 2) - 0.5);
    const double influence = 2 * radius * (0.5 + random_unit(seed, i, 3));
    blobs.push_back({center, influence});
    support = unite(support, cube(center, influence));
    slope += 1.5835 / influence;
  }
  return {support, slope, [=](const Vec3& p) {
            ValueAndGradient sum;
            for (const auto& [center, influence] : blobs) {
              const Vec3 d = (p - center) / influence;
              const double v = glm::dot(d, d), t = 1 - v;
              if (t <= 0) continue;
              sum.value += t * t * (1 - 4 * v / 9);
              sum.gradient += (-4 * t * (1 - 4 * v / 9) - 8 * t * t / 9) / influence * d;
            }
            return sum;
          }};
}

}  // namespace barkridge::test
