#include "blobtree/line_kernels.h"

#include "blobtree/falloff.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/line_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, ConeColumns::kWidth>;
using Vec = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Single precision makes at most this relative error in places and lengths here.
constexpr double kRounding = 4e-6;
// And so much in a difference of places, of their distance from the origin.
constexpr double kPlaceRounding = 5e-7;

HWY_INLINE Vec constant(double x) { return hn::Set(Tag(), static_cast<float>(x)); }
HWY_INLINE Vec load(const ConeColumns::Column& column, std::size_t i) { return hn::Load(Tag(), &column[i]); }
HWY_INLINE Vec clamped(Vec x, Vec lo, Vec hi) { return hn::Min(hn::Max(x, lo), hi); }
HWY_INLINE Vec square(Vec x) { return hn::Mul(x, x); }

struct Vec3V {
  Vec x, y, z;
};
HWY_INLINE Vec3V load(const std::array<ConeColumns::Column, 3>& columns, std::size_t i) {
  return {load(columns[0], i), load(columns[1], i), load(columns[2], i)};
}
HWY_INLINE Vec dot(const Vec3V& a, const Vec3V& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
// a - s b
HWY_INLINE Vec3V less(const Vec3V& a, Vec s, const Vec3V& b) {
  return {hn::NegMulAdd(s, b.x, a.x), hn::NegMulAdd(s, b.y, a.y), hn::NegMulAdd(s, b.z, a.z)};
}

// Where lanes find their cones: beside their lines, or in the first lane.
struct OwnCone {
  static Vec get(const ConeColumns::Column& column, std::size_t i) { return load(column, i); }
};
struct FirstCone {
  static Vec get(const ConeColumns::Column& column, std::size_t) { return hn::Set(Tag(), column[0]); }
};
template <typename Which>
HWY_INLINE Vec3V get(const std::array<ConeColumns::Column, 3>& columns, std::size_t i) {
  return {Which::get(columns[0], i), Which::get(columns[1], i), Which::get(columns[2], i)};
}

// What matters of a cone wherever the line is.
struct Cones {
  Vec radius, taper, steepness2;  // of the foot of a point: at the base, its growth, and 4 times that squared
  Vec along_lo, along_hi;         // the places on the axis beside which the field can be other than zero
  Vec lateral;                    // the largest distance from it at which it can
  Vec axis_lo, axis_hi;           // the places of the spheres' centres
  Mask is_plain, is_limited;
  Vec rise_end, rise_slope, fall_start, fall_slope;  // slopes in size; 0 where the end is free
};

template <typename Which>
HWY_INLINE Cones cones_of(const ConeColumns& c, std::size_t i) {
  const Tag d;
  const Vec zero = hn::Zero(d), endless = constant(1e30);
  Cones k;
  k.radius = Which::get(c.base_radius, i);
  k.taper = Which::get(c.taper, i);
  k.steepness2 = hn::Mul(constant(4), square(k.taper));
  k.is_plain = hn::Gt(Which::get(c.is_plain, i), zero);
  k.is_limited = hn::Gt(Which::get(c.limited_slope, i), zero);
  const Vec length = Which::get(c.length, i), tip = hn::MulAdd(k.taper, length, k.radius);
  const Vec thick = hn::Max(k.radius, tip), thin = hn::Min(k.radius, tip);
  const Vec rise_start = Which::get(c.rise_start, i), fall_start = Which::get(c.fall_start, i);
  const Mask free_base = hn::Lt(rise_start, hn::Neg(endless)), free_tip = hn::Gt(fall_start, endless);
  // Steep cones' caps are larger.
  const Mask is_steep = hn::Ge(k.steepness2, constant(0.98));
  const Vec base_cap = hn::IfThenElse(is_steep, hn::Mul(constant(4), thick), hn::Add(k.radius, k.radius));
  const Vec tip_cap = hn::IfThenElse(is_steep, hn::Mul(constant(4), thick), hn::Add(tip, tip));
  const Vec rise_width = hn::Div(constant(1), Which::get(c.rise_scale, i)),
            fall_width = hn::Div(constant(1), Which::get(c.fall_scale, i));
  k.along_lo = hn::IfThenElse(free_base, hn::Neg(base_cap), rise_start);
  k.along_hi = hn::IfThenElse(free_tip, hn::Add(length, tip_cap), hn::Add(fall_start, fall_width));
  k.axis_lo = hn::IfThenElse(free_base, zero, hn::Neg(endless));
  k.axis_hi = hn::IfThenElse(free_tip, length, endless);
  k.rise_end = hn::IfThenElse(free_base, hn::Neg(endless), hn::Add(rise_start, rise_width));
  k.fall_start = hn::IfThenElse(free_tip, endless, fall_start);
  k.rise_slope = hn::IfThenElse(free_base, zero, hn::Mul(constant(kSteepestFade), Which::get(c.rise_scale, i)));
  k.fall_slope = hn::IfThenElse(free_tip, zero, hn::Mul(constant(kSteepestFade), Which::get(c.fall_scale, i)));
  // The envelope of the spheres of twice the radius, never beyond the largest.
  const Vec most = hn::Mul(hn::IfThenElse(k.is_plain, constant(2), constant(4)), thick);
  const Vec least = hn::IfThenElse(k.is_plain, thin, hn::Mul(constant(0.5), thin));
  const Vec rising = hn::Max(hn::Mul(k.taper, k.along_lo), hn::Mul(k.taper, k.along_hi));
  const Vec widest = hn::Max(hn::Add(k.radius, rising), least);
  const Vec spread = hn::Sqrt(hn::Max(hn::Sub(constant(1), k.steepness2), constant(1e-2)));
  const Vec envelope = hn::Div(hn::Add(widest, widest), spread);
  k.lateral = hn::IfThenElse(is_steep, most, hn::Min(envelope, most));
  return k;
}

struct Heights {
  Vec lo, hi;
};

// Bounds of a cone's field on the part of a piece in its support, of which are known the heights on the axis and that
// the square of the distance from it is at least `rho2`; and whether it is steady on the `whole` piece.
struct Strength {
  Vec highest, slope, least_second, most_second;
  Mask is_steady;
};

template <typename Which>
HWY_INLINE Strength strength(const ConeColumns& c, const Cones& k, std::size_t i, const Heights& part,
                             const Heights& whole_piece, Vec rho2) {
  const Vec y_lo = part.lo, y_hi = part.hi;
  const Tag d;
  const Vec zero = hn::Zero(d), one = constant(1);
  const Mask grows = hn::Ge(k.taper, zero);
  Strength s;
  // v = rho^2 / (4 (foot^2 + taper^2 rho^2)) rises with the distance and falls with the radius at the foot. Where
  // limits are at work, spheres are not larger than the support tells.
  const Vec foot = hn::Max(hn::MulAdd(k.taper, hn::IfThenElse(grows, y_hi, y_lo), k.radius), zero);
  const Vec whole = hn::IfThenElse(k.is_limited, square(k.lateral),
                                   hn::MulAdd(k.steepness2, rho2, hn::Mul(constant(4), square(foot))));
  const Vec v = hn::Min(hn::Mul(hn::Div(rho2, hn::Max(whole, constant(1e-30))), constant(1 - 1e-5)), one);
  const Vec t = hn::Sub(one, v);
  const Vec falloff = hn::Mul(square(t), hn::NegMulAdd(v, constant(4.0 / 9), one));
  s.highest = hn::MulAdd(falloff, constant(1 + 1e-5), constant(1e-7));

  // The nearest sphere is not smaller than that at the foot of the point, which is kept on the axis.
  const Vec thin_end = hn::IfThenElse(grows, y_lo, y_hi);
  const Vec thin = hn::MulAdd(k.taper, clamped(thin_end, k.axis_lo, k.axis_hi), k.radius);
  const Vec free_slope = hn::Div(constant(0.5 * (1 + 1e-5)), hn::Max(thin, constant(1e-16)));
  const Vec slope = hn::IfThenElse(k.is_limited, Which::get(c.limited_slope, i), free_slope);  // of u
  const Vec rise = hn::IfThenElseZero(hn::Lt(y_lo, k.rise_end), k.rise_slope);
  const Vec fall = hn::IfThenElseZero(hn::Gt(y_hi, k.fall_start), k.fall_slope);
  const Vec steeper = hn::Max(rise, fall), field_slope = hn::Mul(constant(kSteepestFalloff), slope);
  s.slope = hn::Add(field_slope, steeper);

  // (w g)'' = w g'' + 2 w' g' + w'' g. Along a line u of a cone can bend down as that of a cylinder cannot
  // [cone_record.cpp, downward_bend].
  constexpr double kBentOverSteep = kMostBentFade / (kSteepestFade * kSteepestFade);
  const Vec bent = hn::Mul(constant(kBentOverSteep), hn::MulAdd(rise, rise, square(fall)));
  const Vec mixed = hn::MulAdd(hn::Add(steeper, steeper), field_slope, bent), slope2 = square(slope);
  const Interval second = falloff_second(0);
  const Vec up = hn::MulAdd(constant(4 * kSteepestFalloff), hn::Abs(k.taper), constant(second.hi));
  const Vec unknown = hn::Inf(d);
  s.least_second = hn::IfThenElse(k.is_limited, hn::Neg(unknown), hn::Sub(hn::Mul(constant(second.lo), slope2), mixed));
  // Where the windows overlap, the weight's limit at zero is a crease, upward.
  const Mask has_crease = hn::Or(k.is_limited, hn::Gt(k.rise_end, k.fall_start));
  s.most_second = hn::IfThenElse(has_crease, unknown, hn::MulAdd(up, slope2, mixed));

  // The nearest sphere's centre is off the foot by no more than `sweep`, towards the thick end: no cap, fade or limit.
  const Vec margin = hn::Mul(constant(kRounding), hn::Add(hn::Abs(whole_piece.hi), k.lateral));
  const Vec sweep = hn::Div(hn::Mul(k.taper, square(k.lateral)), hn::Max(thin, constant(1e-16)));
  const Vec first = hn::Max(hn::Add(k.axis_lo, hn::Max(hn::Neg(sweep), zero)), k.rise_end);
  const Vec last = hn::Min(hn::Sub(k.axis_hi, hn::Max(sweep, zero)), k.fall_start);
  s.is_steady = hn::AndNot(k.is_limited, hn::And(hn::Ge(whole_piece.lo, hn::Add(first, margin)),
                                                 hn::Le(whole_piece.hi, hn::Sub(last, margin))));
  return s;
}

HWY_INLINE unsigned bits_of(Mask mask, std::size_t i) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag(), mask, bytes);
  return (static_cast<unsigned>(bytes[0]) | static_cast<unsigned>(bytes[1]) << 8) << i;
}

template <typename Which>
HWY_INLINE void meet_all(const ConeColumns& cones, const LineColumns& lines, std::size_t count, ConesMet& met) {
  const Tag d;
  const Vec zero = hn::Zero(d), tiny = constant(1e-12);
  met.met = met.steady = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Cones k = cones_of<Which>(cones, i);
    // The line in the cone's coordinates: y = y0 + y1 t, rho^2 = n0 + 2 n1 t + n2 t^2.
    const Vec half = load(lines.half, i), slack = load(lines.slack, i);
    const Vec3V base = get<Which>(cones.base, i), axis = get<Which>(cones.axis, i);
    const Vec3V middle = load(lines.middle, i), along = load(lines.direction, i);
    const Vec3V from_base{hn::Sub(middle.x, base.x), hn::Sub(middle.y, base.y), hn::Sub(middle.z, base.z)};
    const Vec y0 = dot(from_base, axis), y1 = dot(along, axis);
    const Vec3V beside = less(from_base, y0, axis), aside = less(along, y1, axis);
    const Vec n0 = dot(beside, beside), n1 = dot(beside, aside), n2 = hn::Max(dot(aside, aside), tiny);
    // What places and squares of distances are off by.
    const Vec size = hn::Add(half, k.lateral), length = hn::Add(hn::Abs(y0), size);
    const Vec far = hn::Max(hn::Max(hn::Abs(middle.x), hn::Abs(middle.y)), hn::Abs(middle.z));
    const Vec place_rounding = hn::Mul(constant(kPlaceRounding), far);
    const Vec rounding = hn::MulAdd(constant(kRounding), length, place_rounding), off2 = hn::Mul(rounding, size);
    const Vec off = hn::Add(rounding, slack);
    // Where it is beside the axis' part and near enough to it.
    const Vec lateral2 = hn::Add(square(hn::Add(k.lateral, slack)), off2);
    const Vec discriminant = hn::NegMulAdd(n2, hn::Sub(n0, lateral2), square(n1));
    const Vec root = hn::Sqrt(hn::Max(discriminant, zero)), across = hn::Div(constant(1), n2);
    const Vec nearest = hn::Neg(hn::Mul(n1, across)), chord = hn::Mul(root, across);
    const Vec per_height = hn::Div(constant(1), hn::IfThenElse(hn::Lt(hn::Abs(y1), tiny), tiny, y1));
    const Vec enters = hn::Mul(hn::Sub(hn::Sub(k.along_lo, off), y0), per_height);
    const Vec leaves = hn::Mul(hn::Sub(hn::Add(k.along_hi, off), y0), per_height);
    const Vec lo = hn::Max(hn::Max(hn::Neg(half), hn::Min(enters, leaves)), hn::Sub(nearest, chord));
    const Vec hi = hn::Min(hn::Min(half, hn::Max(enters, leaves)), hn::Add(nearest, chord));
    const Mask is_met = hn::And(hn::Ge(discriminant, zero), hn::Le(lo, hi));
    if (hn::AllFalse(d, is_met)) continue;

    const Vec at = clamped(nearest, lo, hi);
    Vec rho2 = hn::Max(hn::MulAdd(at, hn::MulAdd(at, n2, hn::Add(n1, n1)), hn::Sub(n0, off2)), zero);
    if (!hn::AllFalse(d, hn::Gt(slack, zero))) rho2 = square(hn::Max(hn::Sub(hn::Sqrt(rho2), slack), zero));
    const Vec y_a = hn::MulAdd(y1, lo, y0), y_b = hn::MulAdd(y1, hi, y0);
    // What is steady is evaluated so all along the piece, also where it has left the support.
    const Vec y_half = hn::MulAdd(hn::Abs(y1), half, hn::Add(slack, place_rounding));
    const Heights part{hn::Max(hn::Sub(hn::Min(y_a, y_b), slack), hn::Sub(k.along_lo, rounding)),
                       hn::Min(hn::Add(hn::Max(y_a, y_b), slack), hn::Add(k.along_hi, rounding))};
    const Heights whole{hn::Sub(y0, y_half), hn::Add(y0, y_half)};
    const Strength s = strength<Which>(cones, k, i, part, whole, rho2);
    const Vec per_half = hn::Div(constant(1), hn::Max(half, constant(1e-30)));
    hn::Store(hn::Mul(lo, per_half), d, &met.lo[i]);
    hn::Store(hn::Mul(hi, per_half), d, &met.hi[i]);
    hn::Store(s.highest, d, &met.highest[i]);
    hn::Store(s.slope, d, &met.slope[i]);
    hn::Store(s.least_second, d, &met.least_second[i]);
    hn::Store(s.most_second, d, &met.most_second[i]);
    met.met |= bits_of(is_met, i);
    met.steady |= bits_of(s.is_steady, i);
  }
}

void MeetCones(const ConeColumns& cones, const LineColumns& lines, std::size_t count, ConesMet& met) {
  meet_all<OwnCone>(cones, lines, count, met);
}

void MeetFirstCone(const ConeColumns& cones, const LineColumns& lines, std::size_t count, ConesMet& met) {
  meet_all<FirstCone>(cones, lines, count, met);
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(MeetCones);
HWY_EXPORT(MeetFirstCone);

void meet_cones(const ConeColumns& cones, const LineColumns& lines, std::size_t count, ConesMet& met) {
  HWY_DYNAMIC_DISPATCH(MeetCones)(cones, lines, count, met);
}

void meet_first_cone(const ConeColumns& cones, const LineColumns& lines, std::size_t count, ConesMet& met) {
  HWY_DYNAMIC_DISPATCH(MeetFirstCone)(cones, lines, count, met);
}

}  // namespace barkridge
#endif
