#include "blobtree/bend_kernels.h"

#include <algorithm>
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

// A bend's sizes, in units of the model.
struct Arc {
  double radius, half_arc, half_chord, sagitta;
  double sine, cosine;  // of the half angle

  Arc(const Warp::BendData& bend, double scale)
      : radius(scale * bend.arc_radius),
        half_arc(radius * bend.half_angle),
        half_chord(0.5 * scale * bend.chord),
        // 1 - cos without cancellation.
        sagitta(radius * bend.sine * bend.sine / (1 + bend.cosine)),
        sine(bend.sine),
        cosine(bend.cosine) {}
};

// A point in the frame, from the arc's middle: `a` towards the tip, `v` towards the bulge. The arc may be much larger
// than all that happens at it, so that what is counted from its centre is known but coarsely. `past` is how far beyond
// the nearer end it lies in the direction of the chord; there space goes on straight. [docs/field.md, "Bend"]
struct Polar {
  Vec a, v, past, b, rho;  // b and rho from the centre
  hn::Mask<Tag> is_past;
};

HWY_INLINE Polar polar(const Arc& arc, Vec a, Vec v) {
  Polar p{a, v, hn::Sub(hn::Abs(a), constant(arc.half_chord)), hn::Add(v, constant(arc.radius)), {}, {}};
  p.rho = hn::Sqrt(hn::MulAdd(a, a, hn::Mul(p.b, p.b)));
  // Beyond the radius through the end.
  p.is_past =
      hn::Gt(hn::Mul(constant(arc.cosine), p.past), hn::Mul(constant(arc.sine), hn::Add(v, constant(arc.sagitta))));
  return p;
}

// The image of a point in the frame, from the straightened arc's middle.
struct Straightened {
  Vec along, out;
};

HWY_INLINE Straightened straightened(const Arc& arc, const Polar& p) {
  const Vec sine = constant(arc.sine), cosine = constant(arc.cosine), radius = constant(arc.radius);
  const Vec over_end = hn::Add(p.v, constant(arc.sagitta));
  const Vec along = hn::MulSub(cosine, p.past, hn::Mul(sine, over_end));
  const Vec out = hn::MulAdd(sine, p.past, hn::Mul(cosine, over_end));
  const Vec angle = hn::Atan(Tag(), hn::Div(p.a, hn::Max(p.b, constant(1e-30))));
  // rho - R without cancellation.
  const Vec rise = hn::Div(hn::MulAdd(p.a, p.a, hn::Mul(p.v, hn::Add(p.b, radius))), hn::Add(p.rho, radius));
  return {hn::IfThenElse(p.is_past, hn::CopySign(hn::Add(constant(arc.half_arc), along), p.a), hn::Mul(radius, angle)),
          hn::IfThenElse(p.is_past, out, rise)};
}

// Where an origin lies in the bend's frame, from the arc's middle, in units of the model.
HWY_INLINE Vec3 origin_from_middle(const Warp::BendData& bend, const Arc& arc, double scale, const Vec3& origin) {
  const Vec3 local = scale * bend.frame.to_local(origin);
  return {local.x - arc.half_chord, local.y - arc.sagitta, local.z};
}

void BendPoints(const Warp::BendData& bend, double scale, const PointBatch& from, const PointBatch& to) {
  const Arc arc(bend, scale);
  const Vec3 start = origin_from_middle(bend, arc, scale, from.origin), target = scale * bend.frame.to_local(to.origin);
  for (std::size_t i = 0; i < from.size; i += hn::Lanes(Tag())) {
    const Vec3V q = to_local(bend.frame.axes, load(from.at, i));
    const Polar p = polar(arc, hn::Add(q.x, constant(start.x)), hn::Add(q.y, constant(start.y)));
    const Straightened s = straightened(arc, p);
    Vec3V r;
    r.x = hn::Add(s.along, constant(arc.half_arc - target.x));
    r.y = hn::Sub(s.out, constant(target.y));
    r.z = hn::Add(q.z, constant(start.z - target.z));
    store(to_world(bend.frame.axes, r), to.at, i);
  }
}

HWY_INLINE Vec3V load(const std::array<ConeColumns::Column, 3>& columns, std::size_t i) {
  const Tag d;
  return {hn::Load(d, &columns[0][i]), hn::Load(d, &columns[1][i]), hn::Load(d, &columns[2][i])};
}
HWY_INLINE void store(const Vec3V& v, std::array<ConeColumns::Column, 3>& columns, std::size_t i) {
  const Tag d;
  hn::Store(v.x, d, &columns[0][i]);
  hn::Store(v.y, d, &columns[1][i]);
  hn::Store(v.z, d, &columns[2][i]);
}
HWY_INLINE Vec square(Vec x) { return hn::Mul(x, x); }
HWY_INLINE Vec length(Vec x, Vec y) { return hn::Sqrt(hn::MulAdd(x, x, square(y))); }

// Along a line the polar angle rises or falls, so that the ends tell where on the arc the piece is: the same as
// Warp::map does for a piece [warp.cpp], with margins for single precision.
void BendPieces(const Warp::BendData& bend, double scale, const PieceColumns& pieces, std::size_t count,
                BentPieces& bent) {
  const Tag d;
  const Vec zero = hn::Zero(d), one = constant(1), half = constant(0.5);
  const Arc arc(bend, scale);
  const Vec3 start = origin_from_middle(bend, arc, scale, pieces.origin);
  const Vec radius = constant(arc.radius);
  const Vec reached = constant(std::max(arc.radius - scale * bend.reach, 1e-9 * arc.radius));
  // What places are off by, of their distances from the arc's middle, and from its centre.
  constexpr double kRounding = 1e-6;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Vec3V world_from = load(pieces.from, i), world_to = load(pieces.to, i);
    const Vec3V q = to_local(bend.frame.axes, world_from), r = to_local(bend.frame.axes, world_to);
    const Polar p = polar(arc, hn::Add(q.x, constant(start.x)), hn::Add(q.y, constant(start.y)));
    const Polar o = polar(arc, hn::Add(r.x, constant(start.x)), hn::Add(r.y, constant(start.y)));
    const Straightened a = straightened(arc, p), b = straightened(arc, o);
    const Vec3V from{a.along, a.out, hn::Add(q.z, constant(start.z))};
    const Vec3V to{b.along, b.out, hn::Add(r.z, constant(start.z))};
    const Vec3V way{hn::Sub(to.x, from.x), hn::Sub(to.y, from.y), hn::Sub(to.z, from.z)};
    const Vec chord = hn::Sqrt(hn::MulAdd(way.x, way.x, hn::MulAdd(way.y, way.y, square(way.z))));
    const hn::Mask<Tag> has_chord = hn::Gt(chord, constant(1e-20));
    const Vec per_chord = hn::Div(one, hn::IfThenElse(has_chord, chord, one));
    const Vec3V middle{hn::Mul(half, hn::Add(from.x, to.x)), hn::Mul(half, hn::Add(from.y, to.y)),
                       hn::Mul(half, hn::Add(from.z, to.z))};
    const Vec3V direction{hn::IfThenElse(has_chord, hn::Mul(way.x, per_chord), one), hn::Mul(way.y, per_chord),
                          hn::Mul(way.z, per_chord)};

    // In the plane of the arc: how near to the centre the piece comes, and how far from it.
    const Vec u = hn::Sub(o.a, p.a), v = hn::Sub(o.v, p.v), way2 = hn::MulAdd(u, u, square(v));
    const Vec toward = hn::Neg(hn::MulAdd(p.a, u, hn::Mul(p.b, v)));
    const Vec t = hn::Min(hn::Max(hn::Div(toward, hn::Max(way2, constant(1e-30))), zero), one);
    const Vec far = hn::Max(p.rho, o.rho), rounding = hn::Mul(constant(kRounding), hn::Max(far, radius));
    const Vec least = hn::Sub(length(hn::MulAdd(t, u, p.a), hn::MulAdd(t, v, p.b)), rounding);
    const Vec nearest = hn::Max(least, reached);
    // Behind the centre the angle jumps from one end to the other.
    const auto crosses = hn::Or(hn::Le(hn::Mul(p.a, o.a), zero), hn::Le(hn::Min(hn::Abs(p.a), hn::Abs(o.a)), rounding));
    const auto may_pass_behind = hn::And(crosses, hn::Le(hn::Min(p.b, o.b), rounding));
    const auto both_past = hn::And(p.is_past, o.is_past);
    const auto same_side = hn::Gt(hn::Mul(p.a, o.a), zero);
    const auto lies_straight = hn::AndNot(may_pass_behind, hn::And(both_past, same_side));
    const auto may_leave_arc = hn::Or(hn::Or(p.is_past, o.is_past), may_pass_behind);
    const Vec stretch = hn::Max(one, hn::Div(radius, nearest));
    const Vec widening = hn::Max(hn::Sub(stretch, one), hn::Sub(one, hn::Div(radius, hn::Max(far, nearest))));
    const Vec jump = hn::IfThenElseZero(may_leave_arc, hn::Mul(constant(2 * (1 + 1e-5)), widening));
    const Vec curvature = hn::Mul(constant(1 + 1e-5), hn::Div(hn::Sqrt(hn::MulAdd(stretch, stretch, one)), nearest));
    const Vec bent_curvature = hn::IfThenElse(lies_straight, zero, curvature);
    const Vec bent_jump = hn::IfThenElse(lies_straight, zero, jump);
    const Vec3V line{hn::Sub(world_to.x, world_from.x), hn::Sub(world_to.y, world_from.y),
                     hn::Sub(world_to.z, world_from.z)};
    const Vec size = hn::Sqrt(hn::MulAdd(line.x, line.x, hn::MulAdd(line.y, line.y, square(line.z))));
    const Vec off =
        hn::Mul(size, hn::MulAdd(constant(0.25), bent_jump, hn::Mul(constant(0.125), hn::Mul(bent_curvature, size))));

    store(to_world(bend.frame.axes, middle), bent.chords.middle, i);
    store(to_world(bend.frame.axes, direction), bent.chords.direction, i);
    hn::Store(hn::Mul(half, chord), d, &bent.chords.half[i]);
    const Vec size_at_arc = hn::Max(hn::Max(hn::Abs(from.x), hn::Abs(to.x)), hn::Max(hn::Abs(from.y), hn::Abs(to.y)));
    const Vec margin = hn::Mul(constant(kRounding), hn::Add(size_at_arc, constant(arc.half_arc)));
    hn::Store(hn::Min(hn::MulAdd(off, constant(1 + 1e-5), margin), constant(1e15)), d, &bent.chords.slack[i]);
    hn::Store(hn::IfThenElse(lies_straight, one, stretch), d, &bent.stretch[i]);
    hn::Store(bent_curvature, d, &bent.curvature[i]);
    hn::Store(bent_jump, d, &bent.jump[i]);
  }
}

void BendGradients(const Warp::BendData& bend, double scale, const PointBatch& points, const FieldColumns& field) {
  const Arc arc(bend, scale);
  const Vec3 start = origin_from_middle(bend, arc, scale, points.origin);
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(Tag())) {
    const Vec3V q = to_local(bend.frame.axes, load(points.at, i));
    const Polar p = polar(arc, hn::Add(q.x, constant(start.x)), hn::Add(q.y, constant(start.y)));
    const Vec inverse = hn::Div(constant(1), hn::Max(p.rho, constant(1e-30)));
    const Vec sine = hn::IfThenElse(p.is_past, hn::CopySign(constant(arc.sine), p.a), hn::Mul(p.a, inverse));
    const Vec cosine = hn::IfThenElse(p.is_past, constant(arc.cosine), hn::Mul(p.b, inverse));
    const Vec stretch = hn::IfThenElse(p.is_past, constant(1), hn::Mul(constant(arc.radius), inverse));
    const Vec3V g = to_local(bend.frame.axes, load(field.gradient, i));
    const Vec tangential = hn::Mul(stretch, g.x);
    // Transposed Jacobian times gradient.
    const Vec3V turned{hn::MulAdd(cosine, tangential, hn::Mul(sine, g.y)),
                       hn::MulSub(cosine, g.y, hn::Mul(sine, tangential)), g.z};
    store(to_world(bend.frame.axes, turned), field.gradient, i);
  }
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(BendPoints);
HWY_EXPORT(BendPieces);
HWY_EXPORT(BendGradients);

void bend_points(const Warp::BendData& bend, double scale, const PointBatch& from, const PointBatch& to) {
  HWY_DYNAMIC_DISPATCH(BendPoints)(bend, scale, from, to);
}

void bend_pieces(const Warp::BendData& bend, double scale, const PieceColumns& pieces, std::size_t count,
                 BentPieces& bent) {
  HWY_DYNAMIC_DISPATCH(BendPieces)(bend, scale, pieces, count, bent);
}

void bend_gradients(const Warp::BendData& bend, double scale, const PointBatch& points, const FieldColumns& field) {
  HWY_DYNAMIC_DISPATCH(BendGradients)(bend, scale, points, field);
}

}  // namespace barkridge
#endif
