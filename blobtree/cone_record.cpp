#include "blobtree/cone_record.h"

#include <algorithm>
#include <cmath>

#include "blobtree/falloff.h"
#include "blobtree/primitive.h"
#include "blobtree/primitive_bounds.h"

namespace barkridge {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Single precision makes at most this relative error in lengths and values, and this error in places.
constexpr double kRounding = 2e-6;
double place_rounding(const ModelUnits& units) { return units.origin_spacing * 0x1p-22; }

// A cone over the range of places that a box covers.
struct Reach {
  double y, rho2, rho_hi;  // of the box's centre; the largest distance from the axis
  Interval along;          // axial places
  double half_diagonal;
};

Reach reach_of(const ConeRecord& c, const ModelUnits& units, const Box& box) {
  const double scale = units.scale;
  const Vec3 axis(c.axis), from_base = scale * (box.center() - c.base), half = scale * box.half_extent();
  const double y = glm::dot(from_base, axis), y_reach = glm::dot(glm::abs(axis), half);
  const Vec3 beside = from_base - y * axis;
  const double rho2 = glm::dot(beside, beside), half_diagonal = glm::length(half);
  const double rounding = kRounding * (std::abs(y) + y_reach + c.length + c.base_radius) + place_rounding(units);
  return {y, rho2, std::sqrt(rho2) + half_diagonal, {y - y_reach - rounding, y + y_reach + rounding}, half_diagonal};
}

// What one of a faded cone's steps along its axis can be.
struct FadeRange {
  Interval value;
  double slope = 0;
};

FadeRange fade_range(const Interval& y, double start, double scale) {
  // Most of a tree is outside the windows.
  const Interval t{(y.lo - start) * scale, (y.hi - start) * scale};
  if (t.lo >= 1) return {{1, 1}, 0};
  if (t.hi <= 0) return {{0, 0}, 0};
  const double steepest = t.contains(0.5) ? kSteepestFade : std::max(fade_slope(t.lo), fade_slope(t.hi));
  return {{fade(t.lo), fade(t.hi)}, steepest * scale};
}

// The limits within which a record's radius and axial places are kept.
struct Limits {
  Interval radius;
  Interval axis;
};

Limits limits_of(const ConeRecord& c, ConeKind kind) {
  const double r0 = c.base_radius, r1 = c.tip_radius(), thin = std::min(r0, r1), thick = std::max(r0, r1);
  if (kind == ConeKind::kPlain) return {{thin, thick}, {0, c.length}};
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  return {{0.5 * thin, 2 * thick}, {c.has_free_base() ? 0.0 : -kEndless, c.has_free_tip() ? c.length : kEndless}};
}

// The nearest sphere's normalised distance u at the box's centre.
double distance_at_center(const ConeRecord& c, ConeKind kind, const Limits& limits, const Reach& reach) {
  const double r0 = c.base_radius, s = c.taper;
  const double foot = r0 + s * reach.y;
  double center;
  if (kind == ConeKind::kPlain && foot <= 0) {
    center = s > 0 ? c.length : 0;
  } else {
    const double rc = kind == ConeKind::kPlain ? foot : std::max(foot, limits.radius.lo);
    center = std::clamp(reach.y + s * reach.rho2 / rc, limits.axis.lo, limits.axis.hi);
  }
  const double radius = std::clamp(r0 + s * center, limits.radius.lo, limits.radius.hi);
  return std::sqrt((reach.y - center) * (reach.y - center) + reach.rho2) / (2 * radius);
}

struct DistanceSlope {
  double slope;      // a bound of |grad u|
  bool is_unlimited;  // whether no limit of radius or axis is at work anywhere
};

// Where no radius is limited, u grows by 1 / (2 r) a length. The derivatives of a faded cone's limited formulas, with
// k = (s rho / rc)^2, are bounded by the rest.
DistanceSlope distance_slope(const ConeRecord& c, ConeKind kind, const Limits& limits, const Reach& reach) {
  const double r0 = c.base_radius, s = c.taper, rho2 = reach.rho_hi * reach.rho_hi;
  const Interval foot{r0 + std::min(s * reach.along.lo, s * reach.along.hi),
                      r0 + std::max(s * reach.along.lo, s * reach.along.hi)};
  const double least = limits.radius.lo * (1 + kRounding);
  const bool foot_limited = foot.lo < least;
  const double rc = std::max(foot.lo, limits.radius.lo);
  const double sweep = s * rho2 / rc * (1 + kRounding);
  Interval center{reach.along.lo + std::min(0.0, sweep), reach.along.hi + std::max(0.0, sweep)};
  const bool capped = center.lo <= limits.axis.lo || center.hi >= limits.axis.hi;
  if (kind == ConeKind::kPlain) {
    // Where the foot's radius is not positive the nearest sphere is the thick end.
    if (foot_limited) center = limits.axis;
    center = {std::clamp(center.lo, limits.axis.lo, limits.axis.hi),
              std::clamp(center.hi, limits.axis.lo, limits.axis.hi)};
    const double lowest = std::max(limits.radius.lo, r0 + std::min(s * center.lo, s * center.hi));
    return {1 / (2 * lowest), !foot_limited && !capped};
  }
  center = {std::clamp(center.lo, limits.axis.lo, limits.axis.hi),
            std::clamp(center.hi, limits.axis.lo, limits.axis.hi)};
  const Interval tapered{r0 + std::min(s * center.lo, s * center.hi), r0 + std::max(s * center.lo, s * center.hi)};
  const double lowest = std::clamp(tapered.lo, limits.radius.lo, limits.radius.hi);
  const bool radius_limited = tapered.lo < least || tapered.hi > limits.radius.hi * (1 - kRounding);
  double slope = 1 / (2 * lowest);
  if (!foot_limited && !radius_limited) return {slope, !capped};
  const double k = s * s * rho2 / (rc * rc);
  if (foot_limited) {
    const double by_rho =
        std::max((1 + 2 * k) / (2 * std::sqrt(1 + k)), 2 * s * s * reach.rho_hi / limits.radius.lo);
    slope = std::max(slope, std::hypot(std::abs(s), by_rho) / lowest);
  }
  if (radius_limited) {
    slope = std::max(slope, std::hypot(1 + 2 * k, k * std::sqrt(k)) / std::sqrt(1 + k) / (2 * lowest));
  }
  return {slope, false};
}

}  // namespace

ConeRecord record_of(const Cone& cone, double scale) {
  ConeRecord record;
  const Vec3 ab = cone.tip - cone.base;
  const double length = glm::length(ab);
  record.base = cone.base;
  record.base_radius = static_cast<float>(scale * cone.base_radius);
  record.rise_start = -kInfinity;
  record.fall_start = kInfinity;
  if (length > 0) {
    record.axis = glm::vec3(ab / length);
    record.taper = static_cast<float>((cone.tip_radius - cone.base_radius) / length);
    record.length = static_cast<float>(scale * length);
  } else {
    record.base_radius = static_cast<float>(scale * std::max(cone.base_radius, cone.tip_radius));
  }
  return record;
}

ConeRecord record_of(const FadedCone& cone, double scale) {
  const FadedConeFrame frame(cone);
  ConeRecord record;
  record.base = cone.base;
  record.axis = glm::vec3(frame.axis);
  record.base_radius = static_cast<float>(scale * cone.base_radius);
  record.taper = static_cast<float>(frame.taper);
  record.length = static_cast<float>(scale * frame.length);
  record.rise_start = static_cast<float>(scale * frame.rise_start);
  record.rise_scale = static_cast<float>(1 / (scale * frame.rise_length));
  record.fall_start = static_cast<float>(scale * frame.fall_start);
  record.fall_scale = static_cast<float>(1 / (scale * frame.fall_length));
  return record;
}

ConeBounds bounds_of(const ConeRecord& c, ConeKind kind, const ModelUnits& units, const Box& box) {
  const Reach reach = reach_of(c, units, box);
  FadeRange rise{{1, 1}, 0}, fall{{0, 0}, 0};
  if (kind == ConeKind::kFaded) {
    rise = fade_range(reach.along, c.rise_start, c.rise_scale);
    fall = fade_range(reach.along, c.fall_start, c.fall_scale);
  }
  const Interval weight{std::max(0.0, rise.value.lo - fall.value.hi), std::max(0.0, rise.value.hi - fall.value.lo)};
  if (weight.hi <= 0) return {};

  const Limits limits = limits_of(c, kind);
  const DistanceSlope distance = distance_slope(c, kind, limits, reach);
  const double u = distance_at_center(c, kind, limits, reach);
  const FieldBounds g = falloff_bounds(u, distance.slope, reach.half_diagonal + place_rounding(units), kRounding);
  if (g.value.hi <= 0) return {};
  const double weight_slope = std::max(rise.slope, fall.slope);
  const double slope = weight.hi * g.slope + g.value.hi * weight_slope;
  return {{{weight.lo * g.value.lo * (1 - kRounding), weight.hi * g.value.hi * (1 + kRounding)},
           units.scale * slope * (1 + 8 * kRounding)},
          distance.is_unlimited && weight.lo == 1};
}

}  // namespace barkridge
