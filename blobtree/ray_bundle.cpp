#include "blobtree/ray_bundle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/ray_bundle.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, RayBundle::kWidth>;
using Vec = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

HWY_INLINE Vec constant(double x) { return hn::Set(Tag(), x); }
HWY_INLINE Vec load(const RayBundle::Column& column, std::size_t i) { return hn::Load(Tag(), &column[i]); }

struct Vec3V {
  Vec x, y, z;
};
HWY_INLINE Vec3V load(const std::array<RayBundle::Column, 3>& columns, std::size_t i) {
  return {load(columns[0], i), load(columns[1], i), load(columns[2], i)};
}
HWY_INLINE Vec3V constant(const Vec3& v) { return {constant(v.x), constant(v.y), constant(v.z)}; }
HWY_INLINE Vec dot(const Vec3V& a, const Vec3V& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vec3V minus(const Vec3V& a, const Vec3V& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
// a + s b
HWY_INLINE Vec3V plus(const Vec3V& a, Vec s, const Vec3V& b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}

RayLanes ClipToCylinder(const RayBundle& rays, RayLanes lanes, const Cylinder& c, RayRanges& parts) {
  const Tag d;
  // A slope that small cannot be told from none.
  const Vec none = constant(1e-12), zero = hn::Zero(d), one = constant(1), endless = hn::Inf(d);
  const Vec3V center = constant(c.center), axis = constant(c.axis);
  const RayLanes chunk = (RayLanes{1} << hn::Lanes(d)) - 1;
  RayLanes met = 0;
  for (std::size_t i = 0; i < rays.count; i += hn::Lanes(d)) {
    if ((lanes >> i & chunk) == 0) continue;
    const Vec3V origin = load(rays.origin, i), direction = load(rays.direction, i);
    // The ray's parameter from the point nearest to the centre on.
    const Vec nearest = dot(minus(center, origin), direction);
    const Vec3V from_center = minus(plus(origin, nearest, direction), center);
    const Vec y = dot(from_center, axis), slope = dot(direction, axis);
    const Vec3V beside = plus(from_center, hn::Neg(y), axis), aside = plus(direction, hn::Neg(slope), axis);
    const Vec a = dot(aside, aside), b = dot(beside, aside);
    const Vec outside = hn::Sub(dot(beside, beside), constant(c.radius * c.radius));

    const Mask goes_across = hn::Gt(a, none);
    const Vec discriminant = hn::Sub(hn::Mul(b, b), hn::Mul(a, outside));
    const Vec root = hn::Sqrt(hn::Max(discriminant, zero)), safe_a = hn::IfThenElse(goes_across, a, one);
    const Mask is_beside =
        hn::Or(hn::And(goes_across, hn::Lt(discriminant, zero)), hn::AndNot(goes_across, hn::Gt(outside, zero)));
    const Vec enters = hn::Div(hn::Sub(hn::Neg(b), root), safe_a), leaves = hn::Div(hn::Sub(root, b), safe_a);

    const Mask goes_along = hn::Gt(hn::Abs(slope), none);
    const Vec half = constant(c.half_length), per_height = hn::Div(one, hn::IfThenElse(goes_along, slope, one));
    const Vec middle = hn::Neg(hn::Mul(y, per_height)), reach = hn::Abs(hn::Mul(half, per_height));
    const Mask is_past = hn::AndNot(goes_along, hn::Gt(hn::Abs(y), half));

    const Vec least = hn::Max(hn::IfThenElse(goes_across, enters, hn::Neg(endless)),
                              hn::IfThenElse(goes_along, hn::Sub(middle, reach), hn::Neg(endless)));
    const Vec most = hn::Min(hn::IfThenElse(goes_across, leaves, endless),
                             hn::IfThenElse(goes_along, hn::Add(middle, reach), endless));
    // No part grows beyond the range by rounding.
    const Vec lo = hn::Max(load(rays.ranges.lo, i), hn::Add(nearest, least));
    const Vec hi = hn::Min(load(rays.ranges.hi, i), hn::Add(nearest, most));
    hn::Store(lo, d, &parts.lo[i]);
    hn::Store(hi, d, &parts.hi[i]);
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::AndNot(hn::Or(is_beside, is_past), hn::Le(lo, hi)), bytes);
    met |= static_cast<RayLanes>(bytes[0]) << i;
  }
  return met & lanes;
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(ClipToCylinder);

RayLanes clip(const RayBundle& rays, RayLanes lanes, const Cylinder& cylinder, RayRanges& parts) {
  return HWY_DYNAMIC_DISPATCH(ClipToCylinder)(rays, lanes, cylinder, parts);
}

}  // namespace barkridge
#endif
