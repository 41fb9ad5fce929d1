#include "blobtree/disc_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/disc_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBatchGranule>;
using Vec = hn::Vec<Tag>;

HWY_INLINE Vec constant(double x) { return hn::Set(Tag(), static_cast<float>(x)); }

void SampleRound(const RoundShape& shape, double scale, const PointBatch& points, const FieldColumns& out) {
  const Tag d;
  const Vec3 axis = glm::normalize(shape.normal), start = scale * (shape.center - points.origin);
  const Vec ax = constant(axis.x), ay = constant(axis.y), az = constant(axis.z), one = constant(1);
  const Vec circle = constant(scale * shape.circle_radius);
  const double influence = 2 * scale * shape.radius;
  const Vec per_influence2 = constant(1 / (influence * influence));
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(d)) {
    const Vec qx = hn::Sub(hn::LoadU(d, points.at[0] + i), constant(start.x));
    const Vec qy = hn::Sub(hn::LoadU(d, points.at[1] + i), constant(start.y));
    const Vec qz = hn::Sub(hn::LoadU(d, points.at[2] + i), constant(start.z));
    const Vec y = hn::MulAdd(qx, ax, hn::MulAdd(qy, ay, hn::Mul(qz, az)));
    const Vec bx = hn::NegMulAdd(y, ax, qx), by = hn::NegMulAdd(y, ay, qy), bz = hn::NegMulAdd(y, az, qz);
    const Vec rho = hn::Sqrt(hn::MulAdd(bx, bx, hn::MulAdd(by, by, hn::Mul(bz, bz))));
    // Past the circle; a ring's circle is all there is of it.
    const Vec past = hn::Sub(rho, circle), over = shape.is_filled ? hn::Max(past, hn::Zero(d)) : past;
    const Vec v = hn::Min(hn::Mul(hn::MulAdd(over, over, hn::Mul(y, y)), per_influence2), one);
    const Vec t = hn::Sub(one, v), near = hn::NegMulAdd(v, constant(4.0 / 9), one);
    hn::StoreU(hn::Mul(hn::Mul(t, t), near), d, out.f + i);
    if (!out.has_gradient()) continue;
    // g' = -2 (1 - v) (1 - 4 v / 9) - 4/9 (1 - v)^2, and v' = 2 (over along rho, y along the axis) / influence^2.
    const Vec slope = hn::Neg(hn::Mul(t, hn::MulAdd(constant(2), near, hn::Mul(constant(4.0 / 9), t))));
    const Vec steep = hn::Mul(hn::Add(slope, slope), per_influence2);
    const Vec across = hn::Mul(steep, hn::Div(over, hn::Max(rho, constant(1e-30)))), along = hn::Mul(steep, y);
    hn::StoreU(hn::MulAdd(across, bx, hn::Mul(along, ax)), d, out.gradient[0] + i);
    hn::StoreU(hn::MulAdd(across, by, hn::Mul(along, ay)), d, out.gradient[1] + i);
    hn::StoreU(hn::MulAdd(across, bz, hn::Mul(along, az)), d, out.gradient[2] + i);
  }
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(SampleRound);

void sample_round(const RoundShape& shape, double scale, const PointBatch& points, const FieldColumns& out) {
  HWY_DYNAMIC_DISPATCH(SampleRound)(shape, scale, points, out);
}

}  // namespace barkridge
#endif
