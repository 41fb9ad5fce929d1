#pragma once
// Numbers that know how they change with the place: a value and its gradient go through a formula together.

#include <algorithm>
#include <cmath>

#include "base/geometry.h"

namespace barkridge {

struct Graded {
  double value = 0;
  Vec3 slope{0};

  Graded() = default;
  Graded(double v) : value(v) {}  // a constant
  Graded(double v, const Vec3& s) : value(v), slope(s) {}
};

inline Graded operator+(const Graded& a, const Graded& b) { return {a.value + b.value, a.slope + b.slope}; }
inline Graded operator-(const Graded& a, const Graded& b) { return {a.value - b.value, a.slope - b.slope}; }
inline Graded operator-(const Graded& a) { return {-a.value, -a.slope}; }
inline Graded operator*(const Graded& a, const Graded& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
inline Graded operator/(const Graded& a, double b) { return {a.value / b, a.slope / b}; }

inline Graded abs(const Graded& a) { return a.value < 0 ? -a : a; }
inline Graded max(const Graded& a, const Graded& b) { return a.value < b.value ? b : a; }
inline Graded min(const Graded& a, const Graded& b) { return b.value < a.value ? b : a; }
inline Graded sqrt(const Graded& a) {
  const double root = std::sqrt(a.value);
  return {root, root > 0 ? a.slope / (2 * root) : Vec3(0)};
}

/// 0 up to `lo`, 1 from `hi` on, 3 t^2 - 2 t^3 between.
inline Graded smooth_step(double lo, double hi, const Graded& a) {
  const double t = std::clamp((a.value - lo) / (hi - lo), 0.0, 1.0);
  return {t * t * (3 - 2 * t), 6 * t * (1 - t) / (hi - lo) * a.slope};
}

inline Graded mix(const Graded& a, const Graded& b, const Graded& share) { return a + (b - a) * share; }

}  // namespace barkridge
