#pragma once
// The oracle of the tracer's tests: no bounds, no acceleration, only many samples along the ray.

#include <optional>
#include <vector>

#include "blobtree/field.h"

namespace barkridge::test {

/// The first inside point along a ray as far as `samples` points in the support and a search around every near miss
/// show.
inline std::optional<double> dense_march(const Field& field, const Ray& ray, int samples) {
  const Interval range = clip(ray, field.support(), {0, std::numeric_limits<double>::infinity()});
  if (range.empty()) return std::nullopt;
  const auto value = [&](double t) {
    const Vec3 p = ray.at(t);
    double v = 0;
    field.values({&p, 1}, {&v, 1});
    return v;
  };
  const double step = (range.hi - range.lo) / samples;
  const auto crossing = [&](double outside, double inside) {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (outside + inside);
      (value(middle) >= kIsoValue ? inside : outside) = middle;
    }
    return inside;
  };
  double before = 0, last = value(range.lo);
  if (last >= kIsoValue) return range.lo;
  for (int i = 1; i <= samples; ++i) {
    const double t = range.lo + i * step, now = value(t);
    if (last > before && last >= now) {  // a local maximum: climb it
      double a = t - 2 * step, b = t;
      for (int k = 0; k < 60; ++k) {
        const double c = a + 0.382 * (b - a), d = a + 0.618 * (b - a);
        (value(c) < value(d) ? a : b) = value(c) < value(d) ? c : d;
      }
      if (value(a) >= kIsoValue) return crossing(t - 2 * step, a);
    }
    if (now >= kIsoValue) return crossing(t - step, t);
    before = last;
    last = now;
  }
  return std::nullopt;
}

}  // namespace barkridge::test
