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

// The places that a region covers.
struct Reach {
  Interval along;  // the axis
  double rho_hi;   // the largest distance from it
};

// What one of a faded cone's steps along its axis can be.
struct FadeRange {
  Interval value;
  double slope = 0;
  double second = 0;  // in size
};

FadeRange fade_range(const Interval& y, double start, double scale) {
  // Most of a tree is outside the windows.
  const Interval t{(y.lo - start) * scale, (y.hi - start) * scale};
  if (t.lo >= 1) return {{1, 1}, 0};
  if (t.hi <= 0) return {{0, 0}, 0};
  const double steepest = t.contains(0.5) ? kSteepestFade : std::max(fade_slope(t.lo), fade_slope(t.hi));
  return {{fade(t.lo), fade(t.hi)}, steepest * scale, kMostBentFade * scale * scale};
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

// The axial places at which the field can be other than zero.
Interval axial_support(const ConeRecord& c) {
  const double r0 = c.base_radius, r1 = c.tip_radius();
  const bool is_steep = 2 * std::abs(c.taper) >= 1;
  const double base_cap = 2 * (is_steep ? 2 * std::max(r0, r1) : r0),
               tip_cap = 2 * (is_steep ? 2 * std::max(r0, r1) : r1);
  return {c.has_free_base() ? -base_cap : c.rise_start,
          c.has_free_tip() ? c.length + tip_cap : c.fall_start + 1 / c.fall_scale};
}

// The largest distance from the axis at which the field can be other than zero between two axial places: that of the
// envelope of the spheres of twice the radius, and never more than the largest radius allows.
double lateral_support(const ConeRecord& c, const Limits& limits, const Interval& along) {
  const double limit = 2 * limits.radius.hi, steepness = 2 * std::abs(c.taper);
  if (steepness >= 0.99) return limit;
  const double radius =
      std::max({c.base_radius + c.taper * along.lo, c.base_radius + c.taper * along.hi, limits.radius.lo});
  return std::min(limit, 2 * radius / std::sqrt(1 - steepness * steepness)) * (1 + kRounding);
}

// The nearest sphere's normalised distance u at an axial place and a squared distance from the axis.
double distance_at(const ConeRecord& c, ConeKind kind, const Limits& limits, double y, double rho2) {
  const double r0 = c.base_radius, s = c.taper;
  const double foot = r0 + s * y;
  double center;
  if (kind == ConeKind::kPlain && foot <= 0) {
    center = s > 0 ? c.length : 0;
  } else {
    const double rc = kind == ConeKind::kPlain ? foot : std::max(foot, limits.radius.lo);
    center = std::clamp(y + s * rho2 / rc, limits.axis.lo, limits.axis.hi);
  }
  const double radius = std::clamp(r0 + s * center, limits.radius.lo, limits.radius.hi);
  return std::sqrt((y - center) * (y - center) + rho2) / (2 * radius);
}

struct DistanceSlope {
  double slope;       // a bound of |grad u|
  bool is_limited;    // whether a limit of the radius is at work anywhere
  bool is_unlimited;  // whether no limit of radius or axis is
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
    return {1 / (2 * lowest), false, !foot_limited && !capped};
  }
  center = {std::clamp(center.lo, limits.axis.lo, limits.axis.hi),
            std::clamp(center.hi, limits.axis.lo, limits.axis.hi)};
  const Interval tapered{r0 + std::min(s * center.lo, s * center.hi), r0 + std::max(s * center.lo, s * center.hi)};
  const double lowest = std::clamp(tapered.lo, limits.radius.lo, limits.radius.hi);
  const bool radius_limited = tapered.lo < least || tapered.hi > limits.radius.hi * (1 - kRounding);
  double slope = 1 / (2 * lowest);
  if (!foot_limited && !radius_limited) return {slope, false, !capped};
  const double k = s * s * rho2 / (rc * rc);
  if (foot_limited) {
    const double by_rho = std::max((1 + 2 * k) / (2 * std::sqrt(1 + k)), 2 * s * s * reach.rho_hi / limits.radius.lo);
    slope = std::max(slope, std::hypot(std::abs(s), by_rho) / lowest);
  }
  if (radius_limited) {
    slope = std::max(slope, std::hypot(1 + 2 * k, k * std::sqrt(k)) / std::sqrt(1 + k) / (2 * lowest));
  }
  return {slope, true, false};
}

// Along a line, u of a cone can bend down as that of a cylinder cannot: seen from the apex it is the sine of the angle
// to the axis over twice the taper.
double downward_bend(const ConeRecord& c, const DistanceSlope& distance) {
  return kSteepestFalloff * 4 * std::abs(c.taper) * distance.slope * distance.slope;
}

// Bounds of the second derivative of weight times falloff.
Interval second_of(const ConeRecord& c, const DistanceSlope& distance, const FieldBounds& g, const Interval& weight,
                   const FadeRange& rise, const FadeRange& fall) {
  if (distance.is_limited) return Interval{-kInfinity, kInfinity};
  const double mixed = 2 * std::max(rise.slope, fall.slope) * g.slope + g.value.hi * (rise.second + fall.second);
  const bool has_crease = weight.lo <= 0 && rise.value.hi > 0 && fall.value.hi > 0;  // of max(0, ..): upward
  return {weight.hi * g.second.lo - mixed,
          has_crease ? kInfinity : weight.hi * (g.second.hi + downward_bend(c, distance)) + mixed};
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

namespace {

// What fades, limits and the steepness of u are in a region, before u itself is known.
struct Setting {
  FadeRange rise{{1, 1}, 0}, fall{{0, 0}, 0};
  Interval weight;
  Limits limits;
  DistanceSlope distance;
};

Interval weight_range(const ConeRecord& c, ConeKind kind, const Interval& along, FadeRange& rise, FadeRange& fall) {
  if (kind == ConeKind::kPlain || kind == ConeKind::kSteady) return {1, 1};
  rise = fade_range(along, c.rise_start, c.rise_scale);
  fall = fade_range(along, c.fall_start, c.fall_scale);
  return {std::max(0.0, rise.value.lo - fall.value.hi), std::max(0.0, rise.value.hi - fall.value.lo)};
}

ConeBounds weighted(const ConeRecord& c, const Setting& setting, const FieldBounds& g, const ModelUnits& units) {
  const auto& [rise, fall, weight, limits, distance] = setting;
  const double slope = weight.hi * g.slope + g.value.hi * std::max(rise.slope, fall.slope);
  const Interval second = second_of(c, distance, g, weight, rise, fall);
  const double scale2 = units.scale * units.scale;
  return {{{weight.lo * g.value.lo * (1 - kRounding), weight.hi * g.value.hi * (1 + kRounding)},
           units.scale * slope * (1 + 8 * kRounding),
           {scale2 * second.lo, scale2 * second.hi}},
          distance.is_unlimited && weight.lo == 1};
}

}  // namespace

ConeSupport support_of(const ConeRecord& c, ConeKind kind) {
  const Interval along = axial_support(c);
  return {along, lateral_support(c, limits_of(c, kind), along)};
}

namespace {

DistanceSlope slope_in_support(const ConeRecord& c) {
  const ConeSupport support = support_of(c, ConeKind::kFaded);
  return distance_slope(c, ConeKind::kFaded, limits_of(c, ConeKind::kFaded), {support.along, support.lateral});
}

}  // namespace

// A limit is at work also where it alone ends the support sideways, or past a free end.
ConeKind kind_of_faded(const ConeRecord& c) {
  const bool ends_support = support_of(c, ConeKind::kFaded).lateral >= 2 * limits_of(c, ConeKind::kFaded).radius.hi;
  const bool is_steep = 8 * c.taper * c.taper > 1;  // then even the lowest radius does not end it past a free end
  return is_steep || ends_support || slope_in_support(c).is_limited ? ConeKind::kLimited : ConeKind::kFaded;
}

double limited_slope(const ConeRecord& c) { return slope_in_support(c).slope; }

ConeBounds bounds_of(const ConeRecord& c, ConeKind kind, const ModelUnits& units, const Box& box) {
  const Vec3 axis(c.axis), from_base = units.scale * (box.center() - c.base), half = units.scale * box.half_extent();
  const double y = glm::dot(from_base, axis), y_reach = glm::dot(glm::abs(axis), half);
  const double rounding = kRounding * (std::abs(y) + y_reach + c.length + c.base_radius) + place_rounding(units);
  // Only places within the support count; the search for the least distance starts from one of them.
  const Interval support = axial_support(c);
  const Interval along{std::max(y - y_reach, support.lo) - rounding, std::min(y + y_reach, support.hi) + rounding};
  if (along.empty()) return {};
  const double y_start = std::clamp(y, along.lo, along.hi);
  Setting setting;
  setting.weight = weight_range(c, kind, along, setting.rise, setting.fall);
  if (setting.weight.hi <= 0) return {};

  const Vec3 beside = from_base - y * axis;
  const double rho2 = glm::dot(beside, beside), half_diagonal = glm::length(half);
  setting.limits = limits_of(c, kind);
  const double rho = std::sqrt(rho2), lateral = lateral_support(c, setting.limits, along);
  setting.distance = distance_slope(c, kind, setting.limits, {along, std::min(rho + half_diagonal, lateral)});
  // Beside the support the slope means nothing; there the way to it counts, on whose end u is 1.
  const double u = rho <= lateral ? distance_at(c, kind, setting.limits, y_start, rho2)
                                  : 1 + (rho - lateral) * setting.distance.slope;
  FieldBounds g = falloff_bounds(u, setting.distance.slope,
                                 half_diagonal + std::abs(y - y_start) + place_rounding(units), kRounding);
  if (g.value.hi <= 0) return {};
  if (y - y_reach < support.lo || y + y_reach > support.hi || rho + half_diagonal > lateral) g.value.lo = 0;
  return weighted(c, setting, g, units);
}

}  // namespace barkridge
