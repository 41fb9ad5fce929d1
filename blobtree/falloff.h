#pragma once
// How a primitive's field falls with distance. [GMW04, section 2.2; docs/field.md, "Falloff"]
//
// Functions of v = u^2, the squared normalised distance, so that no square root is needed. Factored with
// t = max(0, 1 - v) the field is exactly zero outside its support: an evaluation that leaves such primitives out agrees
// to the bit with one that does not.

#include <algorithm>
#include <cmath>

#include "base/geometry.h"

namespace barkridge {

/// g = 1 - 22/9 v + 17/9 v^2 - 4/9 v^3 for v < 1, else 0; g(1/4) = 1/2. `v` >= 0.
inline double falloff(double v) {
  const double t = std::max(0.0, 1.0 - v);
  return t * t * (1.0 - v * (4.0 / 9.0));
}

/// dg/dv.
inline double falloff_slope(double v) {
  const double t = std::max(0.0, 1.0 - v);
  return -t * (2.0 * (1.0 - v * (4.0 / 9.0)) + t * (4.0 / 9.0));
}

/// The u at which the falloff has a value in [0, 1], or a little more.
inline double falloff_distance(double value) {
  double lo = 0, hi = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (lo + hi);
    (falloff(middle * middle) > value ? lo : hi) = middle;
  }
  return hi;
}

/// Where |dg/du| is largest, and how large: the falloff's Lipschitz constant in u.
inline constexpr double kSteepestDistance = 0.50347;
inline constexpr double kSteepestFalloff = 1.58343;

/// The largest |dg/du| for u in [lo, hi], 0 <= lo <= hi. It rises up to kSteepestDistance and falls after it.
inline double steepest_falloff(Interval u) {
  if (u.contains(kSteepestDistance)) return kSteepestFalloff;
  const double end = u.hi < kSteepestDistance ? u.hi : u.lo;
  return std::abs(2.0 * end * falloff_slope(end * end));
}

/// Bounds of the second derivative of the falloff along any line, times the square of the radius of influence, for u of
/// at least `lo`, where u is the distance from a point over that radius: along the line of the gradient it is g'',
/// across it g' / u, which is the lower one and rises with u.
inline Interval falloff_second(double lo) {
  const double v = std::min(1.0, lo * lo);
  return {-44.0 / 9 + v * (68.0 / 9 - v * (24.0 / 9)), 3.79};
}

/// The step that fades a primitive along its axis: 0 for t <= 0, 1 for t >= 1, twice differentiable. Its slope is at
/// most kSteepestFade.
inline double fade(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}
inline double fade_slope(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return 30.0 * t * t * (1.0 - t) * (1.0 - t);
}
inline constexpr double kSteepestFade = 1.875;
inline constexpr double kMostBentFade = 5.7736;  ///< its largest second derivative

}  // namespace barkridge
