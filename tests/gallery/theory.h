#pragma once
// The formulas of docs/field.md once more, in the plainest words, for the answers that the figures are held against:
// one equation in one unknown wherever that will do.

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/geometry.h"
#include "tests/support/degree.h"

namespace barkridge::test {

inline constexpr double kHalf = 0.5;  // the iso-value

/// The outermost root of `f(x) = level` in [lo, hi], for f below `level` at hi: 500 steps, then halved to the last
/// digit.
inline double outermost_root(const std::function<double(double)>& f, double level, double lo, double hi) {
  const double step = (hi - lo) / 500;
  double inside = hi;
  while (inside > lo && f(inside) < level) inside -= step;
  double outside = inside + step;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (f(middle) >= level ? inside : outside) = middle;
  }
  return inside;
}

/// Falloff of the normalised distance u, and its derivative.
inline double g(double u) {
  const double v = u * u;
  return u < 1 ? 1 - 22.0 / 9 * v + 17.0 / 9 * v * v - 4.0 / 9 * v * v * v : 0;
}
inline double g_slope(double u) { return u < 1 ? u * (-44.0 / 9 + u * u * (68.0 / 9 - u * u * 24.0 / 9)) : 0; }
/// How many radii from its axis a line's field has the value f, 0 < f < 1.
inline double radii_at(double f) { return 2 * outermost_root(g, f, 0, 1); }

/// A line of one radius: value and gradient.
struct Line {
  Vec3 base, tip;
  double radius;

  Vec3 nearest(const Vec3& p) const {
    const Vec3 axis = tip - base;
    return base + std::clamp(glm::dot(p - base, axis) / glm::dot(axis, axis), 0.0, 1.0) * axis;
  }
  double value(const Vec3& p) const { return g(glm::distance(p, nearest(p)) / (2 * radius)); }
  Vec3 gradient(const Vec3& p) const {
    const Vec3 away = p - nearest(p);
    const double distance = glm::length(away);
    return g_slope(distance / (2 * radius)) / (2 * radius * distance) * away;
  }
};

/// A tapered line as the largest of all spheres along it: distance over radius falls, then rises along the axis.
inline double largest_sphere(const Vec3& base, const Vec3& tip, double base_radius, double tip_radius, const Vec3& p) {
  const auto u = [&](double t) {
    return glm::distance(p, base + t * (tip - base)) / (2 * (base_radius + t * (tip_radius - base_radius)));
  };
  double lo = 0, hi = 1;
  for (int i = 0; i < 80; ++i) {
    const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
    (u(a) < u(b) ? hi : lo) = u(a) < u(b) ? b : a;
  }
  return g(u(0.5 * (lo + hi)));
}

/// Expansion beside a contact with the default shape, w = 1/2 and M = 1/8, for which the cubic next to the contact has
/// no cubic term and the other one is its mirror's continuation.
inline constexpr double kWidth = 0.5, kSwelling = 0.125;
inline double h(double x) {
  if (x <= 0 || x >= kWidth) return 0;
  if (x <= kWidth / 2) return x - 2 * x * x;
  return (x - kWidth) * (x - kWidth) * (4 * x - kWidth) * 4 * kSwelling / (kWidth * kWidth * kWidth);
}
inline double h_slope(double x) {
  if (x < 0 || x >= kWidth) return 0;
  if (x <= kWidth / 2) return 1 - 4 * x;
  return (x - kWidth) * (12 * x - 6 * kWidth) * 4 * kSwelling / (kWidth * kWidth * kWidth);
}

/// Two children in contact; where they are equal, f is either's value.
inline double contact(double a, double b) {
  const double high = std::max(a, b), low = std::min(a, b);
  return low >= kHalf ? std::max(kHalf, high - (low - kHalf)) : high + h(kHalf - low);
}

/// The angle outside between the two walls of the crease where children of contact are equal, summed with a field of
/// gradient `carrier`: the gradient on a's side is carrier + a' - h' b'.
inline double opening_degrees(const Vec3& carrier, const Vec3& a_gradient, const Vec3& b_gradient, double f) {
  const double slope = h_slope(kHalf - f);
  const Vec3 one = glm::normalize(carrier + a_gradient - slope * b_gradient);
  const Vec3 other = glm::normalize(carrier + b_gradient - slope * a_gradient);
  return std::max(0.0, 180 - std::acos(std::clamp(glm::dot(one, other), -1.0, 1.0)) / kDegree);
}

}  // namespace barkridge::test
