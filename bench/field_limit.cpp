#include "bench/field_limit.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/field_limit.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;
using Vec = hn::Vec<Tag>;

HWY_INLINE Vec constant(float x) { return hn::Set(Tag(), x); }

// A cone in registers.
struct LoadedCone {
  explicit HWY_INLINE LoadedCone(const LimitCone& cone)
      : base{constant(cone.base[0]), constant(cone.base[1]), constant(cone.base[2])},
        axis{constant(cone.axis[0]), constant(cone.axis[1]), constant(cone.axis[2])},
        along{constant(cone.along[0]), constant(cone.along[1]), constant(cone.along[2])},
        base_along(constant(cone.base_along)),
        reach(constant(cone.reach)),
        widening(constant(cone.widening)) {}

  Vec base[3], axis[3], along[3], base_along, reach, widening;
};

// A point against a cone: where it projects, how it stands to that place, and the falloff's argument v = q / R^2.
struct Meeting {
  Vec t, clamped, dx, dy, dz, reach, inverse, v;
};

HWY_INLINE Meeting meet(const LoadedCone& cone, Vec x, Vec y, Vec z) {
  Meeting m;
  m.t = hn::MulAdd(x, cone.along[0], hn::MulAdd(y, cone.along[1], hn::MulSub(z, cone.along[2], cone.base_along)));
  m.clamped = hn::Min(hn::Max(m.t, hn::Zero(Tag())), constant(1));
  m.dx = hn::NegMulAdd(m.clamped, cone.axis[0], hn::Sub(x, cone.base[0]));
  m.dy = hn::NegMulAdd(m.clamped, cone.axis[1], hn::Sub(y, cone.base[1]));
  m.dz = hn::NegMulAdd(m.clamped, cone.axis[2], hn::Sub(z, cone.base[2]));
  m.reach = hn::MulAdd(m.clamped, cone.widening, cone.reach);
  m.inverse = hn::Div(constant(1), hn::Mul(m.reach, m.reach));
  m.v = hn::Mul(hn::MulAdd(m.dx, m.dx, hn::MulAdd(m.dy, m.dy, hn::Mul(m.dz, m.dz))), m.inverse);
  return m;
}

template <int kVectors>
void values(std::span<const LimitCone> cones, LimitColumns& columns) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < columns.size(); i += kVectors * lanes) {
    Vec x[kVectors], y[kVectors], z[kVectors], f[kVectors];
    for (int k = 0; k < kVectors; ++k) {
      const std::size_t at = i + static_cast<std::size_t>(k) * lanes;
      x[k] = hn::LoadU(d, &columns.x[at]);
      y[k] = hn::LoadU(d, &columns.y[at]);
      z[k] = hn::LoadU(d, &columns.z[at]);
      f[k] = hn::Zero(d);
    }
    for (const LimitCone& data : cones) {
      const LoadedCone cone(data);
      for (int k = 0; k < kVectors; ++k) {
        const Vec v = meet(cone, x[k], y[k], z[k]).v;
        const Vec t = hn::Max(hn::Sub(constant(1), v), hn::Zero(d));
        f[k] = hn::MulAdd(hn::Mul(t, t), hn::NegMulAdd(v, constant(4.0f / 9), constant(1)), f[k]);
      }
    }
    for (int k = 0; k < kVectors; ++k) hn::StoreU(f[k], d, &columns.f[i + static_cast<std::size_t>(k) * lanes]);
  }
}

// Adds a cone's field and gradient at a vector of points.
HWY_INLINE void add_sample(const LoadedCone& cone, const Meeting& m, Vec& f, Vec& gx, Vec& gy, Vec& gz) {
  const Vec zero = hn::Zero(Tag());
  const Vec t = hn::Max(hn::Sub(constant(1), m.v), zero);
  const Vec rest = hn::NegMulAdd(m.v, constant(4.0f / 9), constant(1));
  f = hn::MulAdd(hn::Mul(t, t), rest, f);
  // dg/dv, halved: -t (rest + t 2/9). The reach changes with the point only between the ends.
  const Vec half_slope = hn::Neg(hn::Mul(t, hn::MulAdd(t, constant(2.0f / 9), rest)));
  const Vec beside = hn::Mul(constant(4), hn::Mul(half_slope, m.inverse));
  const Vec by_reach =
      hn::Mul(hn::Mul(constant(-4), hn::Mul(half_slope, m.v)), hn::Mul(cone.widening, hn::Mul(m.reach, m.inverse)));
  const Vec onward = hn::IfThenElseZero(hn::Eq(m.t, m.clamped), by_reach);
  gx = hn::MulAdd(beside, m.dx, hn::MulAdd(onward, cone.along[0], gx));
  gy = hn::MulAdd(beside, m.dy, hn::MulAdd(onward, cone.along[1], gy));
  gz = hn::MulAdd(beside, m.dz, hn::MulAdd(onward, cone.along[2], gz));
}

template <int kVectors>
void values_and_gradients(std::span<const LimitCone> cones, LimitColumns& columns) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < columns.size(); i += kVectors * lanes) {
    Vec x[kVectors], y[kVectors], z[kVectors], f[kVectors], gx[kVectors], gy[kVectors], gz[kVectors];
    for (int k = 0; k < kVectors; ++k) {
      const std::size_t at = i + static_cast<std::size_t>(k) * lanes;
      x[k] = hn::LoadU(d, &columns.x[at]);
      y[k] = hn::LoadU(d, &columns.y[at]);
      z[k] = hn::LoadU(d, &columns.z[at]);
      f[k] = gx[k] = gy[k] = gz[k] = hn::Zero(d);
    }
    for (const LimitCone& data : cones) {
      const LoadedCone cone(data);
      for (int k = 0; k < kVectors; ++k) add_sample(cone, meet(cone, x[k], y[k], z[k]), f[k], gx[k], gy[k], gz[k]);
    }
    for (int k = 0; k < kVectors; ++k) {
      const std::size_t at = i + static_cast<std::size_t>(k) * lanes;
      hn::StoreU(f[k], d, &columns.f[at]);
      hn::StoreU(gx[k], d, &columns.gx[at]);
      hn::StoreU(gy[k], d, &columns.gy[at]);
      hn::StoreU(gz[k], d, &columns.gz[at]);
    }
  }
}

void LimitValues(std::span<const LimitCone> cones, LimitColumns& columns, LimitLoop loop) {
  loop == LimitLoop::kTwoVectors ? values<2>(cones, columns) : values<4>(cones, columns);
}

void LimitValuesAndGradients(std::span<const LimitCone> cones, LimitColumns& columns, LimitLoop loop) {
  loop == LimitLoop::kTwoVectors ? values_and_gradients<2>(cones, columns) : values_and_gradients<4>(cones, columns);
}

std::size_t VectorWidth() { return hn::Lanes(Tag()); }

}  // namespace barkridge::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge::bench {

namespace {

HWY_EXPORT(LimitValues);
HWY_EXPORT(LimitValuesAndGradients);
HWY_EXPORT(VectorWidth);

void copy(const Vec3& v, float (&out)[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

}  // namespace

LimitCone::LimitCone(const Cone& cone)
    : reach(static_cast<float>(2 * cone.base_radius)),
      widening(static_cast<float>(2 * (cone.tip_radius - cone.base_radius))) {
  const Vec3 whole = cone.tip - cone.base;
  const Vec3 scaled = whole / glm::dot(whole, whole);
  copy(cone.base, base);
  copy(whole, axis);
  copy(scaled, along);
  base_along = static_cast<float>(glm::dot(cone.base, scaled));
}

LimitColumns::LimitColumns(std::span<const Vec3> points) {
  constexpr std::size_t kGranule = 64;
  const std::size_t size = (points.size() + kGranule - 1) / kGranule * kGranule;
  for (std::vector<float>* column : {&x, &y, &z, &f, &gx, &gy, &gz}) column->assign(size, 0.0f);
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = static_cast<float>(points[i].x);
    y[i] = static_cast<float>(points[i].y);
    z[i] = static_cast<float>(points[i].z);
  }
}

void limit_values(std::span<const LimitCone> cones, LimitColumns& columns, LimitLoop loop) {
  HWY_DYNAMIC_DISPATCH(LimitValues)(cones, columns, loop);
}

void limit_values_and_gradients(std::span<const LimitCone> cones, LimitColumns& columns, LimitLoop loop) {
  HWY_DYNAMIC_DISPATCH(LimitValuesAndGradients)(cones, columns, loop);
}

std::vector<std::int64_t> instruction_sets() {
  choose_instruction_set(0);
  std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::erase_if(
      targets, [](std::int64_t target) { return target == HWY_SCALAR || target == HWY_EMU128 || target == HWY_SSSE3; });
  return {targets.rbegin(), targets.rend()};
}

void choose_instruction_set(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::size_t vector_width() { return HWY_DYNAMIC_DISPATCH(VectorWidth)(); }

}  // namespace barkridge::bench
#endif
