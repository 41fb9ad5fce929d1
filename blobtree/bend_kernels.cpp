#include "blobtree/bend_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/bend_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBatchGranule>;
using Vec = hn::Vec<Tag>;

HWY_INLINE Vec constant(double x) { return hn::Set(Tag(), static_cast<float>(x)); }

struct Vec3V {
  Vec x, y, z;
};

HWY_INLINE Vec3V load(const std::array<float*, 3>& columns, std::size_t i) {
  const Tag d;
  return {hn::LoadU(d, columns[0] + i), hn::LoadU(d, columns[1] + i), hn::LoadU(d, columns[2] + i)};
}
HWY_INLINE void store(const Vec3V& v, const std::array<float*, 3>& columns, std::size_t i) {
  const Tag d;
  hn::StoreU(v.x, d, columns[0] + i);
  hn::StoreU(v.y, d, columns[1] + i);
  hn::StoreU(v.z, d, columns[2] + i);
}

// Into the frame whose axes are the columns of `axes`, and out of it.
HWY_INLINE Vec3V to_local(const Mat3& axes, const Vec3V& p) {
  const auto along = [&](int k) {
    return hn::MulAdd(p.x, constant(axes[k].x),
                      hn::MulAdd(p.y, constant(axes[k].y), hn::Mul(p.z, constant(axes[k].z))));
  };
  return {along(0), along(1), along(2)};
}
HWY_INLINE Vec3V to_world(const Mat3& axes, const Vec3V& q) {
  const auto coordinate = [&](int k) {
    return hn::MulAdd(q.x, constant(axes[0][k]),
                      hn::MulAdd(q.y, constant(axes[1][k]), hn::Mul(q.z, constant(axes[2][k]))));
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

// A point seen from the arc's centre: `a` towards the tip, `b` towards the bulge; whether it lies before an end of the
// arc, or past one, where space goes on straight. [docs/field.md, "Bend"]
struct Polar {
  Vec a, b, rho;
  hn::Mask<Tag> is_past;
  Vec sine, cosine;  // of the turn, kept within the arc
};

HWY_INLINE Polar polar(const Warp::BendData& bend, Vec a, Vec b) {
  const Vec sine = constant(bend.sine), cosine = constant(bend.cosine);
  Polar p{a, b, hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b))), {}, {}, {}};
  p.is_past = hn::Gt(hn::Mul(cosine, hn::Abs(a)), hn::Mul(sine, b));
  const Vec inverse = hn::Div(constant(1), hn::Max(p.rho, constant(1e-30)));
  p.sine = hn::IfThenElse(p.is_past, hn::CopySign(sine, a), hn::Mul(a, inverse));
  p.cosine = hn::IfThenElse(p.is_past, cosine, hn::Mul(b, inverse));
  return p;
}

// Where a batch's origin lies in the bend's frame, from the arc's centre.
HWY_INLINE Vec3 origin_from_center(const Warp::BendData& bend, double scale, const Vec3& origin) {
  const Vec3 local = bend.frame.to_local(origin);
  return scale * Vec3(local.x - 0.5 * bend.chord, local.y - bend.center_height, local.z);
}

void BendPoints(const Warp::BendData& bend, double scale, const PointBatch& from, const PointBatch& to) {
  const Vec3 start = origin_from_center(bend, scale, from.origin), target = scale * bend.frame.to_local(to.origin);
  const double radius = scale * bend.arc_radius;
  const Vec half_arc = constant(radius * bend.half_angle);
  for (std::size_t i = 0; i < from.size; i += hn::Lanes(Tag())) {
    const Vec3V q = to_local(bend.frame.axes, load(from.at, i));
    const Polar p = polar(bend, hn::Add(q.x, constant(start.x)), hn::Add(q.y, constant(start.y)));
    // Past the arc's ends the turn is theirs.
    const Vec angle = hn::Atan(Tag(), hn::Div(p.a, hn::Max(p.b, constant(1e-30))));
    const Vec along = hn::MulSub(p.cosine, p.a, hn::Mul(p.sine, p.b));
    const Vec out = hn::MulAdd(p.sine, p.a, hn::Mul(p.cosine, p.b));
    const Vec axial =
        hn::IfThenElse(p.is_past, hn::Add(hn::CopySign(half_arc, p.a), along), hn::Mul(constant(radius), angle));
    Vec3V r;
    r.x = hn::Add(axial, constant(radius * bend.half_angle - target.x));
    r.y = hn::Sub(hn::IfThenElse(p.is_past, out, p.rho), constant(radius + target.y));
    r.z = hn::Add(q.z, constant(start.z - target.z));
    store(to_world(bend.frame.axes, r), to.at, i);
  }
}

void BendGradients(const Warp::BendData& bend, double scale, const PointBatch& points, const FieldColumns& field) {
  const Vec3 start = origin_from_center(bend, scale, points.origin);
  const Vec radius = constant(scale * bend.arc_radius);
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(Tag())) {
    const Vec3V q = to_local(bend.frame.axes, load(points.at, i));
    const Polar p = polar(bend, hn::Add(q.x, constant(start.x)), hn::Add(q.y, constant(start.y)));
    const Vec stretch = hn::IfThenElse(p.is_past, constant(1), hn::Div(radius, hn::Max(p.rho, constant(1e-30))));
    const Vec3V g = to_local(bend.frame.axes, load(field.gradient, i));
    const Vec tangential = hn::Mul(stretch, g.x);
    // Transposed Jacobian times gradient.
    const Vec3V turned{hn::MulAdd(p.cosine, tangential, hn::Mul(p.sine, g.y)),
                       hn::MulSub(p.cosine, g.y, hn::Mul(p.sine, tangential)), g.z};
    store(to_world(bend.frame.axes, turned), field.gradient, i);
  }
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(BendPoints);
HWY_EXPORT(BendGradients);

void bend_points(const Warp::BendData& bend, double scale, const PointBatch& from, const PointBatch& to) {
  HWY_DYNAMIC_DISPATCH(BendPoints)(bend, scale, from, to);
}

void bend_gradients(const Warp::BendData& bend, double scale, const PointBatch& points, const FieldColumns& field) {
  HWY_DYNAMIC_DISPATCH(BendGradients)(bend, scale, points, field);
}

}  // namespace barkridge
#endif
