#include "blobtree/cone_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/cone_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The kernels for one width of vector. Lanes do not see each other, so a point's bits do not depend on the width.
template <class Tag>
struct Kernels {
  using Vec = hn::Vec<Tag>;

  static HWY_INLINE Vec constant(double x) { return hn::Set(Tag(), x); }

  // Maximum and minimum as std::max(a, b) and std::min(a, b) choose.
  static HWY_INLINE Vec largest(Vec a, Vec b) { return hn::IfThenElse(hn::Lt(a, b), b, a); }
  static HWY_INLINE Vec smallest(Vec a, Vec b) { return hn::IfThenElse(hn::Lt(b, a), b, a); }
  static HWY_INLINE Vec clamped(Vec x, Vec lo, Vec hi) { return smallest(largest(x, lo), hi); }

  static HWY_INLINE Vec falloff(Vec v) {
    const Vec t = largest(hn::Zero(Tag()), hn::Sub(constant(1), v));
    return hn::Mul(hn::Mul(t, t), hn::Sub(constant(1), hn::Mul(v, constant(4.0 / 9))));
  }

  static HWY_INLINE Vec falloff_slope(Vec v) {
    const Vec t = largest(hn::Zero(Tag()), hn::Sub(constant(1), v));
    const Vec near = hn::Mul(constant(2), hn::Sub(constant(1), hn::Mul(v, constant(4.0 / 9))));
    return hn::Neg(hn::Mul(t, hn::Add(near, hn::Mul(t, constant(4.0 / 9)))));
  }

  static HWY_INLINE Vec fade(Vec t) {  // t in [0, 1]
    const Vec cube = hn::Mul(hn::Mul(t, t), t);
    return hn::Mul(cube, hn::Add(constant(10), hn::Mul(t, hn::Sub(hn::Mul(constant(6), t), constant(15)))));
  }

  static HWY_INLINE Vec fade_slope(Vec t) {  // t in [0, 1]
    const Vec rest = hn::Sub(constant(1), t);
    return hn::Mul(constant(30), hn::Mul(hn::Mul(t, t), hn::Mul(rest, rest)));
  }

  // Points relative to an axis: y along it, (bx, by, bz) across it.
  struct AxialPoint {
    Vec y, bx, by, bz, rho2;
  };

  static HWY_INLINE AxialPoint axial_point(const PointBatch& p, std::size_t i, const Vec3& base, const Vec3& axis) {
    const Tag d;
    const Vec ax = constant(axis.x), ay = constant(axis.y), az = constant(axis.z);
    const Vec qx = hn::Sub(hn::LoadU(d, p.x + i), constant(base.x));
    const Vec qy = hn::Sub(hn::LoadU(d, p.y + i), constant(base.y));
    const Vec qz = hn::Sub(hn::LoadU(d, p.z + i), constant(base.z));
    AxialPoint q;
    q.y = hn::Add(hn::Add(hn::Mul(qx, ax), hn::Mul(qy, ay)), hn::Mul(qz, az));
    q.bx = hn::Sub(qx, hn::Mul(q.y, ax));
    q.by = hn::Sub(qy, hn::Mul(q.y, ay));
    q.bz = hn::Sub(qz, hn::Mul(q.y, az));
    q.rho2 = hn::Add(hn::Add(hn::Mul(q.bx, q.bx), hn::Mul(q.by, q.by)), hn::Mul(q.bz, q.bz));
    return q;
  }

  // gradient = along * axis + beside * (point across the axis)
  static HWY_INLINE void store_gradient(const FieldColumns& out, std::size_t i, const AxialPoint& q, const Vec3& axis,
                                        Vec along, Vec beside) {
    const Tag d;
    hn::StoreU(hn::Add(hn::Mul(beside, q.bx), hn::Mul(along, constant(axis.x))), d, out.gx + i);
    hn::StoreU(hn::Add(hn::Mul(beside, q.by), hn::Mul(along, constant(axis.y))), d, out.gy + i);
    hn::StoreU(hn::Add(hn::Mul(beside, q.bz), hn::Mul(along, constant(axis.z))), d, out.gz + i);
  }

  static void cone(const FieldProgramData::ConeData& data, const PointBatch& p, const FieldColumns& out) {
    const Tag d;
    const Vec s = constant(data.taper), r0 = constant(data.cone.base_radius), length = constant(data.length);
    const Vec thick_end = constant(data.taper > 0 ? data.length : 0.0);
    for (std::size_t i = 0; i < p.size; i += hn::Lanes(d)) {
      const AxialPoint q = axial_point(p, i, data.cone.base, data.axis);
      const Vec foot = hn::Add(r0, hn::Mul(s, q.y));
      const Vec inside = clamped(hn::Add(q.y, hn::Div(hn::Mul(s, q.rho2), foot)), hn::Zero(d), length);
      const Vec best = hn::IfThenElse(hn::Gt(foot, hn::Zero(d)), inside, thick_end);
      const Vec radius = hn::Add(r0, hn::Mul(s, best));
      const Vec inverse = hn::Div(constant(0.25), hn::Mul(radius, radius));
      const Vec dy = hn::Sub(q.y, best);
      const Vec v = hn::Mul(hn::Add(hn::Mul(dy, dy), q.rho2), inverse);
      hn::StoreU(falloff(v), d, out.f + i);
      if (out.gx) {
        const Vec slope = hn::Mul(hn::Mul(constant(2), falloff_slope(v)), inverse);
        store_gradient(out, i, q, data.axis, hn::Mul(slope, dy), slope);
      }
    }
  }

  static void faded_cone(const FieldProgramData::FadedConeData& data, const PointBatch& p, const FieldColumns& out) {
    const Tag d;
    const FadedConeFrame& frame = data.frame;
    const Vec zero = hn::Zero(d), one = constant(1);
    const Vec s = constant(frame.taper), r0 = constant(data.cone.base_radius);
    const Vec lowest = constant(frame.lowest_radius), highest = constant(frame.highest_radius);
    const Vec inverse_rise = constant(1 / frame.rise_length), inverse_fall = constant(1 / frame.fall_length);
    for (std::size_t i = 0; i < p.size; i += hn::Lanes(d)) {
      const AxialPoint q = axial_point(p, i, data.cone.base, frame.axis);
      const Vec rise = clamped(hn::Mul(hn::Sub(q.y, constant(frame.rise_start)), inverse_rise), zero, one);
      const Vec fall = clamped(hn::Mul(hn::Sub(q.y, constant(frame.fall_start)), inverse_fall), zero, one);
      const Vec weight = largest(zero, hn::Sub(fade(rise), fade(fall)));

      const Vec foot = hn::Add(r0, hn::Mul(s, q.y));
      const Vec rc = largest(foot, lowest);
      const Vec best = hn::Add(q.y, hn::Div(hn::Mul(s, q.rho2), rc));
      const Vec center = clamped(best, constant(frame.free_axis.lo), constant(frame.free_axis.hi));
      const Vec tapered = hn::Add(r0, hn::Mul(s, center));
      const Vec radius = clamped(tapered, lowest, highest);
      const Vec inverse = hn::Div(constant(0.25), hn::Mul(radius, radius));
      const Vec dy = hn::Sub(q.y, center);
      const Vec v = hn::Mul(hn::Add(hn::Mul(dy, dy), q.rho2), inverse);
      const Vec g = falloff(v);
      hn::StoreU(hn::Mul(weight, g), d, out.f + i);
      if (out.gx) {
        // The nearest sphere's movement with y and rho^2 matters only where a radius is clamped. [docs/field.md]
        const auto moves = hn::Eq(center, best);
        const Vec bend = hn::Div(hn::Mul(hn::Mul(s, s), q.rho2), hn::Mul(rc, rc));
        const Vec center_by_y = hn::IfThenElse(hn::Gt(foot, lowest), hn::Sub(one, bend), one);
        const Vec radius_slope = hn::IfThenElseZero(hn::Eq(radius, tapered), s);
        const Vec by_radius = hn::Mul(hn::Mul(constant(8), v), hn::Mul(radius, radius_slope));
        const Vec v_by_center =
            hn::IfThenElseZero(moves, hn::Neg(hn::Mul(hn::Add(hn::Mul(constant(2), dy), by_radius), inverse)));
        const Vec v_by_y = hn::Add(hn::Mul(hn::Mul(constant(2), dy), inverse), hn::Mul(v_by_center, center_by_y));
        const Vec v_by_rho2 = hn::Add(inverse, hn::Div(hn::Mul(v_by_center, s), rc));
        const Vec slope = hn::Mul(weight, falloff_slope(v));
        const Vec weight_slope = hn::IfThenElseZero(
            hn::Gt(weight, zero),
            hn::Sub(hn::Mul(fade_slope(rise), inverse_rise), hn::Mul(fade_slope(fall), inverse_fall)));
        const Vec along = hn::Add(hn::Mul(slope, v_by_y), hn::Mul(g, weight_slope));
        store_gradient(out, i, q, frame.axis, along, hn::Mul(hn::Mul(slope, constant(2)), v_by_rho2));
      }
    }
  }
};

// At most eight lanes, so that a granule is a whole number of vectors on every set; and two for the single points of
// rays, whose divisions take a fraction of the time.
using Wide = hn::CappedTag<double, kBatchGranule>;
using Narrow = hn::CappedTag<double, 2>;
constexpr std::size_t kNarrowBatch = 2;

void EvaluateCone(const FieldProgramData::ConeData& cone, const PointBatch& p, const FieldColumns& out) {
  p.size <= kNarrowBatch ? Kernels<Narrow>::cone(cone, p, out) : Kernels<Wide>::cone(cone, p, out);
}

void EvaluateFadedCone(const FieldProgramData::FadedConeData& cone, const PointBatch& p, const FieldColumns& out) {
  p.size <= kNarrowBatch ? Kernels<Narrow>::faded_cone(cone, p, out) : Kernels<Wide>::faded_cone(cone, p, out);
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(EvaluateCone);
HWY_EXPORT(EvaluateFadedCone);

void evaluate_cone(const FieldProgramData::ConeData& cone, const PointBatch& points, const FieldColumns& out) {
  HWY_DYNAMIC_DISPATCH(EvaluateCone)(cone, points, out);
}

void evaluate_faded_cone(const FieldProgramData::FadedConeData& cone, const PointBatch& points,
                         const FieldColumns& out) {
  HWY_DYNAMIC_DISPATCH(EvaluateFadedCone)(cone, points, out);
}

}  // namespace barkridge
#endif
