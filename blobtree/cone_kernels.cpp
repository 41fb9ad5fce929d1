#include "blobtree/cone_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/cone_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBatchGranule>;
using Vec = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

HWY_INLINE Vec constant(float x) { return hn::Set(Tag(), x); }
HWY_INLINE Vec clamped(Vec x, Vec lo, Vec hi) { return hn::Min(hn::Max(x, lo), hi); }

HWY_INLINE Vec fade(Vec t) {  // t in [0, 1]
  const Vec cube = hn::Mul(hn::Mul(t, t), t);
  return hn::Mul(cube, hn::MulAdd(t, hn::MulAdd(constant(6), t, constant(-15)), constant(10)));
}

HWY_INLINE Vec fade_slope(Vec t) {  // t in [0, 1]
  const Vec rest = hn::Mul(t, hn::Sub(constant(1), t));
  return hn::Mul(constant(30), hn::Mul(rest, rest));
}

// Points relative to an axis: y along it, b across it.
struct AxialPoint {
  Vec y, bx, by, bz, rho2;
};

HWY_INLINE AxialPoint axial_point(const LocalCone& c, Vec x, Vec y, Vec z) {
  const Vec ax = constant(c.axis[0]), ay = constant(c.axis[1]), az = constant(c.axis[2]);
  const Vec qx = hn::Sub(x, constant(c.base[0]));
  const Vec qy = hn::Sub(y, constant(c.base[1]));
  const Vec qz = hn::Sub(z, constant(c.base[2]));
  AxialPoint q;
  q.y = hn::MulAdd(qx, ax, hn::MulAdd(qy, ay, hn::Mul(qz, az)));
  q.bx = hn::NegMulAdd(q.y, ax, qx);
  q.by = hn::NegMulAdd(q.y, ay, qy);
  q.bz = hn::NegMulAdd(q.y, az, qz);
  q.rho2 = hn::MulAdd(q.bx, q.bx, hn::MulAdd(q.by, q.by, hn::Mul(q.bz, q.bz)));
  return q;
}

// The falloff's argument is v = part / (4 whole). Away from caps and limits the nearest sphere need not be found:
// v = rho^2 / (4 (foot^2 + taper^2 rho^2)) with foot the radius at the point's own height. [docs/field.md, "Cone"]
struct Ratio {
  Vec part, whole;
};

// The derivatives of v along the axis and, over the distance from it, across.
struct RatioSlope {
  Vec along, across;
};

template <typename AnyCone>
HWY_INLINE RatioSlope ratio_slope(const AnyCone& c, Vec foot, Vec v, Vec inverse) {
  const Vec foot_share = hn::Mul(constant(8), hn::Mul(foot, inverse));
  return {hn::Mul(hn::Mul(foot_share, constant(-c.taper)), v), hn::Mul(foot_share, hn::Mul(foot, inverse))};
}

// Where the nearest sphere is an end of the axis, it is at a distance `dy` along it.
struct Ends {
  Mask any;
  Vec dy;
};

HWY_INLINE void apply_end(Mask at_end, Vec dy, float radius, const AxialPoint& q, Ratio& ratio, Ends& ends) {
  ratio.part = hn::IfThenElse(at_end, hn::MulAdd(dy, dy, q.rho2), ratio.part);
  ratio.whole = hn::IfThenElse(at_end, constant(radius * radius), ratio.whole);
  ends.any = hn::Or(ends.any, at_end);
  ends.dy = hn::IfThenElse(at_end, dy, ends.dy);
}

// The nearest sphere lies at y + taper rho^2 / foot, kept between the free ends.
template <typename AnyCone>
HWY_INLINE Ends apply_ends(const AnyCone& c, const AxialPoint& q, Vec foot, bool base, bool tip, Ratio& ratio) {
  Ends ends{hn::MaskFromVec(hn::Zero(Tag())), hn::Zero(Tag())};
  const Vec sweep = hn::Mul(constant(c.taper), q.rho2);
  if (base) {
    const Mask at_base = hn::Le(hn::MulAdd(q.y, foot, sweep), hn::Zero(Tag()));
    apply_end(at_base, q.y, c.base_radius, q, ratio, ends);
  }
  if (tip) {
    const Vec past = hn::Sub(q.y, constant(c.length));
    const Mask at_tip = hn::Ge(hn::MulAdd(past, foot, sweep), hn::Zero(Tag()));
    apply_end(at_tip, past, c.tip_radius, q, ratio, ends);
  }
  return ends;
}

HWY_INLINE void apply_ends(const Ends& ends, Vec inverse, RatioSlope& slope) {
  const Vec twice = hn::Add(inverse, inverse);
  slope.along = hn::IfThenElse(ends.any, hn::Mul(twice, ends.dy), slope.along);
  slope.across = hn::IfThenElse(ends.any, twice, slope.across);
}

struct Accumulator {
  Vec f, gx, gy, gz;
};

HWY_INLINE Vec falloff_of(Vec v, Vec& t, Vec& near) {
  t = hn::Max(hn::Sub(constant(1), v), hn::Zero(Tag()));
  near = hn::NegMulAdd(v, constant(4.0f / 9), constant(1));
  return hn::Mul(hn::Mul(t, t), near);
}

// Adds falloff and, where wanted, gradient of a cone without weight, with or without caps.
template <bool kGradients, bool kCapped, typename AnyCone>
HWY_INLINE void add_plain(const AnyCone& c, const AxialPoint& q, Accumulator& sum) {
  const Vec foot = hn::MulAdd(constant(c.taper), q.y, constant(c.base_radius));
  Ratio ratio{q.rho2, hn::MulAdd(foot, foot, hn::Mul(constant(c.taper * c.taper), q.rho2))};
  Ends ends;
  if constexpr (kCapped) ends = apply_ends(c, q, foot, true, true, ratio);
  const Vec inverse = hn::Div(constant(0.25f), ratio.whole);
  const Vec v = hn::Mul(ratio.part, inverse);
  Vec t, near;
  sum.f = hn::Add(sum.f, falloff_of(v, t, near));
  if constexpr (kGradients) {
    RatioSlope slope = ratio_slope(c, foot, v, inverse);
    if constexpr (kCapped) apply_ends(ends, inverse, slope);
    const Vec fall = hn::Neg(hn::Mul(t, hn::MulAdd(constant(4.0f / 9), t, hn::Add(near, near))));
    const Vec along = hn::Mul(fall, slope.along), across = hn::Mul(fall, slope.across);
    sum.gx = hn::Add(sum.gx, hn::MulAdd(across, q.bx, hn::Mul(along, constant(c.axis[0]))));
    sum.gy = hn::Add(sum.gy, hn::MulAdd(across, q.by, hn::Mul(along, constant(c.axis[1]))));
    sum.gz = hn::Add(sum.gz, hn::MulAdd(across, q.bz, hn::Mul(along, constant(c.axis[2]))));
  }
}

template <typename AnyCone>
HWY_INLINE float lowest_radius(const AnyCone& c) {
  return 0.5f * (c.base_radius < c.tip_radius ? c.base_radius : c.tip_radius);
}
template <typename AnyCone>
HWY_INLINE float highest_radius(const AnyCone& c) {
  return 2.0f * (c.base_radius < c.tip_radius ? c.tip_radius : c.base_radius);
}

// The limits of a faded cone's radius. Where one is at work, with rc the foot kept above the lowest radius, e =
// taper^2 rho^2, m = foot rc + e kept between the limits times rc: v = rho^2 (rc^2 + e) / (4 m^2).
struct Limited {
  Mask any;
  Vec rc, square, kept;
  Mask foot_is_free, kept_is_free, kept_is_high;
};

template <typename AnyCone>
HWY_INLINE Limited limited(const AnyCone& c, const AxialPoint& q, Vec foot, Vec e, Ratio& ratio) {
  const float lowest = lowest_radius(c), highest = highest_radius(c);
  Limited l;
  l.rc = hn::Max(foot, constant(lowest));
  l.foot_is_free = hn::Ge(foot, constant(lowest));
  const Vec m = hn::MulAdd(foot, l.rc, e);
  const Vec low = hn::Mul(constant(lowest), l.rc), high = hn::Mul(constant(highest), l.rc);
  l.kept = clamped(m, low, high);
  l.kept_is_free = hn::Eq(m, l.kept);
  l.kept_is_high = hn::Gt(m, high);
  l.any = hn::Not(hn::And(l.foot_is_free, l.kept_is_free));
  l.square = hn::MulAdd(l.rc, l.rc, e);
  ratio.part = hn::IfThenElse(l.any, hn::Mul(q.rho2, l.square), ratio.part);
  ratio.whole = hn::IfThenElse(l.any, hn::Mul(l.kept, l.kept), ratio.whole);
  return l;
}

HWY_INLINE void limit_slope(const LocalCone& c, const Limited& l, const AxialPoint& q, Vec foot, RatioSlope& slope) {
  const float lowest = lowest_radius(c), highest = highest_radius(c);
  const Vec s = constant(c.taper), s2 = constant(c.taper * c.taper);
  const Vec inverse = hn::Div(constant(1), l.kept);
  const Vec rc_by_y = hn::IfThenElseZero(l.foot_is_free, s);
  const Vec square_by_y = hn::Mul(constant(2), hn::Mul(l.rc, rc_by_y));
  const Vec free_by_y = hn::MulAdd(s, l.rc, hn::Mul(foot, rc_by_y));
  const Vec limit = hn::IfThenElse(l.kept_is_high, constant(highest), constant(lowest));
  const Vec kept_by_y = hn::IfThenElse(l.kept_is_free, free_by_y, hn::Mul(limit, rc_by_y));
  const Vec kept_by_rho2 = hn::IfThenElseZero(l.kept_is_free, s2);
  const Vec share = hn::Mul(l.square, inverse);
  const Vec quarter = hn::Mul(constant(0.25f), inverse);
  // d(square / kept^2) = (d square - 2 square / kept d kept) / kept^2
  const Vec by_y = hn::Mul(inverse, hn::NegMulAdd(hn::Add(share, share), kept_by_y, square_by_y));
  const Vec by_rho2 = hn::Mul(inverse, hn::NegMulAdd(hn::Add(share, share), kept_by_rho2, s2));
  const Vec along = hn::Mul(quarter, hn::Mul(q.rho2, by_y));
  const Vec across = hn::Mul(hn::Add(quarter, quarter), hn::MulAdd(q.rho2, by_rho2, share));
  slope.along = hn::IfThenElse(l.any, along, slope.along);
  slope.across = hn::IfThenElse(l.any, across, slope.across);
}

template <bool kGradients, bool kLimited, typename AnyCone>
HWY_INLINE void add_faded(const AnyCone& c, const AxialPoint& q, Accumulator& sum) {
  const Vec zero = hn::Zero(Tag()), one = constant(1);
  const Vec rise = clamped(hn::Mul(hn::Sub(q.y, constant(c.rise_start)), constant(c.rise_scale)), zero, one);
  const Vec fall = clamped(hn::Mul(hn::Sub(q.y, constant(c.fall_start)), constant(c.fall_scale)), zero, one);
  const Vec weight = hn::Max(hn::Sub(fade(rise), fade(fall)), zero);

  // Where no limit is at work in the support, this keeps it so past a free end, where the cone's other half begins.
  const Vec straight = hn::MulAdd(constant(c.taper), q.y, constant(c.base_radius));
  const Vec foot = kLimited ? straight : hn::Max(straight, constant(lowest_radius(c)));
  const Vec e = hn::Mul(constant(c.taper * c.taper), q.rho2);
  Ratio ratio{q.rho2, hn::MulAdd(foot, foot, e)};
  Limited l;
  if constexpr (kLimited) l = limited(c, q, foot, e, ratio);
  const Ends ends = apply_ends(c, q, kLimited ? l.rc : foot, c.free_base, c.free_tip, ratio);
  const Vec inverse = hn::Div(constant(0.25f), ratio.whole);
  const Vec v = hn::Mul(ratio.part, inverse);
  Vec t, near;
  const Vec g = falloff_of(v, t, near);
  sum.f = hn::MulAdd(weight, g, sum.f);
  if constexpr (kGradients) {
    RatioSlope slope = ratio_slope(c, foot, v, inverse);
    if constexpr (kLimited) {
      if (!hn::AllFalse(Tag(), l.any)) limit_slope(c, l, q, foot, slope);
    }
    apply_ends(ends, inverse, slope);
    const Vec down = hn::Neg(hn::Mul(t, hn::MulAdd(constant(4.0f / 9), t, hn::Add(near, near))));
    const Vec weight_slope = hn::IfThenElseZero(
        hn::Gt(weight, zero),
        hn::Sub(hn::Mul(fade_slope(rise), constant(c.rise_scale)), hn::Mul(fade_slope(fall), constant(c.fall_scale))));
    const Vec weighted = hn::Mul(weight, down);
    const Vec along = hn::MulAdd(g, weight_slope, hn::Mul(weighted, slope.along));
    const Vec across = hn::Mul(weighted, slope.across);
    sum.gx = hn::Add(sum.gx, hn::MulAdd(across, q.bx, hn::Mul(along, constant(c.axis[0]))));
    sum.gy = hn::Add(sum.gy, hn::MulAdd(across, q.by, hn::Mul(along, constant(c.axis[1]))));
    sum.gz = hn::Add(sum.gz, hn::MulAdd(across, q.bz, hn::Mul(along, constant(c.axis[2]))));
  }
}

// Adds one cone at all points: its numbers, a copy that no column can alias, stay in registers meanwhile.
template <bool kGradients, ConeKind kKind>
void add_cone(const LocalCone c, const PointBatch& p, const FieldColumns& out) {
  const Tag d;
  for (std::size_t i = 0; i < p.size; i += hn::Lanes(d)) {
    const Vec x = hn::LoadU(d, p.at[0] + i), y = hn::LoadU(d, p.at[1] + i), z = hn::LoadU(d, p.at[2] + i);
    Accumulator sum{hn::LoadU(d, out.f + i), {}, {}, {}};
    if constexpr (kGradients) {
      sum.gx = hn::LoadU(d, out.gradient[0] + i);
      sum.gy = hn::LoadU(d, out.gradient[1] + i);
      sum.gz = hn::LoadU(d, out.gradient[2] + i);
    }
    const AxialPoint q = axial_point(c, x, y, z);
    if constexpr (kKind == ConeKind::kFaded || kKind == ConeKind::kLimited) {
      add_faded<kGradients, kKind == ConeKind::kLimited>(c, q, sum);
    } else {
      add_plain<kGradients, kKind == ConeKind::kPlain>(c, q, sum);
    }
    hn::StoreU(sum.f, d, out.f + i);
    if constexpr (kGradients) {
      hn::StoreU(sum.gx, d, out.gradient[0] + i);
      hn::StoreU(sum.gy, d, out.gradient[1] + i);
      hn::StoreU(sum.gz, d, out.gradient[2] + i);
    }
  }
}

template <bool kGradients>
void sum_all(std::span<const LocalCone> cones, const PointBatch& p, const FieldColumns& out) {
  std::fill_n(out.f, p.size, 0.0f);
  if constexpr (kGradients) {
    for (float* column : out.gradient) std::fill_n(column, p.size, 0.0f);
  }
  for (const LocalCone& c : cones) {
    switch (c.kind) {
      case ConeKind::kPlain:
        add_cone<kGradients, ConeKind::kPlain>(c, p, out);
        break;
      case ConeKind::kFaded:
        add_cone<kGradients, ConeKind::kFaded>(c, p, out);
        break;
      case ConeKind::kSteady:
        add_cone<kGradients, ConeKind::kSteady>(c, p, out);
        break;
      case ConeKind::kLimited:
        add_cone<kGradients, ConeKind::kLimited>(c, p, out);
        break;
    }
  }
}

void SumCones(std::span<const LocalCone> cones, const PointBatch& points, const FieldColumns& out) {
  out.has_gradient() ? sum_all<true>(cones, points, out) : sum_all<false>(cones, points, out);
}

template <ConeKind kKind>
void add_cone_along(const LineCone c, const float* t, float* f) {
  const Tag d;
  for (std::size_t i = 0; i < kBatchGranule; i += hn::Lanes(d)) {
    const Vec at = hn::Sub(hn::LoadU(d, t + i), constant(c.nearest));
    AxialPoint q;  // only its height and distance count where no gradient is wanted
    q.y = hn::MulAdd(at, constant(c.y1), constant(c.y0));
    q.rho2 = hn::MulAdd(at, hn::MulAdd(at, constant(c.across2), constant(c.slope)), constant(c.rho2));
    q.rho2 = hn::Max(q.rho2, hn::Zero(d));
    Accumulator sum;
    sum.f = hn::LoadU(d, f + i);
    if constexpr (kKind == ConeKind::kFaded || kKind == ConeKind::kLimited) {
      add_faded<false, kKind == ConeKind::kLimited>(c, q, sum);
    } else {
      add_plain<false, kKind == ConeKind::kPlain>(c, q, sum);
    }
    hn::StoreU(sum.f, d, f + i);
  }
}

void SumConesAlong(std::span<const LineCone> cones, const float* t, float* f) {
  std::fill_n(f, kBatchGranule, 0.0f);
  for (const LineCone& c : cones) {
    switch (c.kind) {
      case ConeKind::kPlain:
        add_cone_along<ConeKind::kPlain>(c, t, f);
        break;
      case ConeKind::kFaded:
        add_cone_along<ConeKind::kFaded>(c, t, f);
        break;
      case ConeKind::kSteady:
        add_cone_along<ConeKind::kSteady>(c, t, f);
        break;
      case ConeKind::kLimited:
        add_cone_along<ConeKind::kLimited>(c, t, f);
        break;
    }
  }
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(SumCones);

void sum_cones(std::span<const LocalCone> cones, const PointBatch& points, const FieldColumns& out) {
  HWY_DYNAMIC_DISPATCH(SumCones)(cones, points, out);
}

HWY_EXPORT(SumConesAlong);

void sum_cones_along(std::span<const LineCone> cones, const float* t, float* f) {
  HWY_DYNAMIC_DISPATCH(SumConesAlong)(cones, t, f);
}

namespace {

ConeShape shape_of(const ConeRecord& record, ConeKind kind) {
  return {record.base_radius,   record.tip_radius(), record.taper,      record.length, record.rise_start,
          record.rise_scale,    record.fall_start,   record.fall_scale, kind,          record.has_free_base(),
          record.has_free_tip()};
}

}  // namespace

LineCone line_cone(const ConeRecord& record, ConeKind kind, const Vec3& origin, const Vec3& direction, double scale,
                   double reach) {
  // Counted from the nearest approach within reach on, what is small is so without cancellation.
  const Vec3 axis(record.axis), from_base = scale * (origin - record.base);
  const double y1 = glm::dot(direction, axis);
  const Vec3 aside = direction - y1 * axis;
  const double across2 = glm::dot(aside, aside);
  const double nearest = across2 > 1e-12 ? std::clamp(-glm::dot(from_base, aside) / across2, -reach, reach) : 0;
  const Vec3 from_base_there = from_base + nearest * direction;
  const double y0 = glm::dot(from_base_there, axis);
  const Vec3 beside = from_base_there - y0 * axis;
  return {shape_of(record, kind),
          static_cast<float>(nearest),
          static_cast<float>(y0),
          static_cast<float>(y1),
          static_cast<float>(glm::dot(beside, beside)),
          static_cast<float>(2 * glm::dot(beside, aside)),
          static_cast<float>(across2)};
}

LocalCone local_cone(const ConeRecord& record, ConeKind kind, const Vec3& origin, double scale) {
  const Vec3 base = scale * (record.base - origin);
  return {shape_of(record, kind),
          {static_cast<float>(base.x), static_cast<float>(base.y), static_cast<float>(base.z)},
          {record.axis.x, record.axis.y, record.axis.z}};
}

}  // namespace barkridge
#endif
