#include "blobtree/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace barkridge {

namespace {

// The cubic of the half next to the contact, c x^3 + e x^2 + x.
struct NearCubic {
  double c, e;
};

NearCubic near_cubic(const ContactShape& shape) {
  const double w = shape.width, m = shape.swelling;
  return {4.0 * (w - 4.0 * m) / (w * w * w), 4.0 * (3.0 * m - w) / (w * w)};
}

}  // namespace

void check(const ContactShape& shape) {
  const double w = shape.width, m = shape.swelling;
  if (!(0 < w && w <= kIsoValue)) {
    throw InputError(fmt::format("contact width {} is outside its range: 0 < width <= {}", w, kIsoValue));
  }
  const double highest = shape.allow_large_swelling ? 0.5 : w / 3.0;
  if (!(w / 6.0 * (1 - 1e-12) <= m && m <= highest * (1 + 1e-12))) {
    throw InputError(
        fmt::format("contact swelling {} is outside its range for width {}: {:.6g} <= swelling <= {:.6g}{}", m, w,
                    w / 6.0, highest, shape.allow_large_swelling ? "" : " (up to 0.5 with allow_large_swelling)"));
  }
}

double contact_expansion(const ContactShape& shape, double x) {
  const double w = shape.width, m = shape.swelling;
  if (!(x > 0 && x < w)) return 0;
  if (x <= w / 2) {
    const auto [c, e] = near_cubic(shape);
    return x * (1.0 + x * (e + x * c));
  }
  return 4.0 * m / (w * w * w) * (x - w) * (x - w) * (4.0 * x - w);
}

double contact_expansion_slope(const ContactShape& shape, double x) {
  const double w = shape.width, m = shape.swelling;
  if (!(x >= 0 && x < w)) return 0;
  if (x <= w / 2) {
    const auto [c, e] = near_cubic(shape);
    return 1.0 + x * (2.0 * e + 3.0 * c * x);
  }
  return 4.0 * m / (w * w * w) * (x - w) * (12.0 * x - 6.0 * w);
}

// Where |h'| <= 1, h falls to zero at the width no faster than T - x, which is not below zero there.
bool is_below_sum(const ContactShape& shape) { return 3.0 * shape.swelling <= shape.width * (1 + 1e-12); }

double most_bent_expansion(const ContactShape& shape) {
  // Both cubics' second derivatives are linear: the largest are at their ends.
  const double w = shape.width, m = shape.swelling;
  const auto [c, e] = near_cubic(shape);
  const double far = 4.0 * m / (w * w * w);
  return std::max({std::abs(2 * e), std::abs(2 * e + 3 * c * w), std::abs(far * (24 * w - 18 * w)),
                   std::abs(far * (12 * w - 18 * w))});
}

ContactRange contact_range(const ContactShape& shape, const Interval& f) {
  ContactRange range;
  if (f.hi >= kIsoValue) range.steepest_effect = 1;
  const Interval x{std::max(0.0, kIsoValue - f.hi), std::min(shape.width, kIsoValue - f.lo)};
  if (x.empty()) return range;
  // h rises up to w / 2 and falls after it.
  const double half = shape.width / 2;
  if (f.hi < kIsoValue && kIsoValue - f.lo < shape.width) {
    range.lowest_expansion = std::min(contact_expansion(shape, x.lo), contact_expansion(shape, x.hi));
  }
  range.highest_expansion =
      x.contains(half) ? shape.swelling : std::max(contact_expansion(shape, x.lo), contact_expansion(shape, x.hi));
  // h' is a parabola on either half: its extremes are at ends and vertices. At w itself the slope is 0 from both sides.
  const auto consider = [&](double at) {
    if (x.contains(at)) {
      range.steepest_effect = std::max(range.steepest_effect, std::abs(contact_expansion_slope(shape, at)));
    }
  };
  consider(x.lo);
  consider(x.hi);
  consider(0.75 * shape.width);
  const auto [c, e] = near_cubic(shape);
  if (c != 0) {
    const double vertex = -e / (3.0 * c);
    if (vertex > 0 && vertex < half) consider(vertex);
  }
  return range;
}

}  // namespace barkridge
