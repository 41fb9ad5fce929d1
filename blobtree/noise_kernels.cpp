#include "blobtree/noise_kernels.h"

#include <cmath>

#include "base/noise.h"
#include "blobtree/solid_noise.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/noise_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBatchGranule>;
using Vec = hn::Vec<Tag>;
using IntTag = hn::RebindToSigned<Tag>;
using BitsTag = hn::RebindToUnsigned<Tag>;
using Bits = hn::Vec<BitsTag>;

HWY_INLINE Vec constant(double x) { return hn::Set(Tag(), static_cast<float>(x)); }
HWY_INLINE Bits bits(std::uint32_t x) { return hn::Set(BitsTag(), x); }

// A coordinate in the lattice: the cell's faces below and above as the hash takes them, how far the point is over the
// lower one, and its weight for the upper one.
struct Cell {
  Bits lower, upper;
  Vec over, weight, weight_slope;
};

// `start` is the origin's coordinate, too large for single precision; the offset is small.
HWY_INLINE Cell cell_at(double start, Vec offset, std::uint32_t factor) {
  const double floor = std::floor(start);
  const Vec x = hn::Add(offset, constant(start - floor));
  const Vec lower = hn::Floor(x);
  Cell cell;
  const auto first = static_cast<std::uint32_t>(static_cast<std::int64_t>(floor));
  const Bits number = hn::Add(hn::BitCast(BitsTag(), hn::ConvertTo(IntTag(), lower)), bits(first));
  cell.lower = hn::Mul(number, bits(factor));
  cell.upper = hn::Add(cell.lower, bits(factor));
  cell.over = hn::Sub(x, lower);
  const Vec t = cell.over, rest = hn::Mul(t, hn::Sub(t, constant(1)));
  cell.weight =
      hn::Mul(hn::Mul(hn::Mul(t, t), t), hn::MulAdd(t, hn::MulAdd(constant(6), t, constant(-15)), constant(10)));
  cell.weight_slope = hn::Mul(constant(30), hn::Mul(rest, rest));
  return cell;
}

HWY_INLINE Vec with_sign(Vec x, Bits sign) { return hn::BitCast(Tag(), hn::Xor(hn::BitCast(BitsTag(), x), sign)); }

struct Sum {
  Vec value, x, y, z;
};

// Adds what a corner of the cell does: see gradient_noise.
template <bool kGradient>
HWY_INLINE void add_corner(Bits hash, const Vec (&d)[3], const Vec (&w)[3], const Vec (&slope)[3], Sum& sum) {
  hash = hn::Mul(hn::Xor(hash, hn::ShiftRight<16>(hash)), bits(kFirstHashFactor));
  hash = hn::Mul(hn::Xor(hash, hn::ShiftRight<15>(hash)), bits(kSecondHashFactor));
  hash = hn::Xor(hash, hn::ShiftRight<16>(hash));
  const auto across = hn::BitCast(IntTag(), hn::And(hash, bits(0xffff)));
  const auto across_z = hn::RebindMask(Tag(), hn::Lt(across, hn::Set(IntTag(), kAcrossZ)));
  const auto across_x = hn::RebindMask(Tag(), hn::Gt(across, hn::Set(IntTag(), kAcrossY - 1)));
  const Bits sign = bits(0x80000000u);
  const Bits first = hn::And(hash, sign), second = hn::And(hn::ShiftLeft<1>(hash), sign);
  const Vec ramp = hn::Add(with_sign(hn::IfThenElse(across_x, d[1], d[0]), first),
                           with_sign(hn::IfThenElse(across_z, d[1], d[2]), second));
  const Vec weight_yz = hn::Mul(w[1], w[2]), weight = hn::Mul(w[0], weight_yz);
  sum.value = hn::MulAdd(weight, ramp, sum.value);
  if constexpr (kGradient) {
    const Vec a = with_sign(weight, first), b = with_sign(weight, second);
    const Vec rw0 = hn::Mul(ramp, w[0]);
    sum.x = hn::MulAdd(hn::Mul(ramp, slope[0]), weight_yz, hn::Add(sum.x, hn::IfThenZeroElse(across_x, a)));
    // Along y it is the first one's where that is across x, the second one's where it is across z.
    sum.y = hn::MulAdd(hn::Mul(rw0, slope[1]), w[2],
                       hn::Add(sum.y, hn::IfThenElse(across_x, a, hn::IfThenElseZero(across_z, b))));
    sum.z = hn::MulAdd(hn::Mul(rw0, slope[2]), w[1], hn::Add(sum.z, hn::IfThenZeroElse(across_z, b)));
  }
}

template <bool kGradient>
HWY_INLINE Sum noise_in(const Cell& x, const Cell& y, const Cell& z, std::uint32_t seed) {
  const Vec zero = hn::Zero(Tag()), one = constant(1);
  Sum sum{zero, zero, zero, zero};
  const Vec rest[3] = {hn::Sub(one, x.weight), hn::Sub(one, y.weight), hn::Sub(one, z.weight)};
  const Vec falling[3] = {hn::Neg(x.weight_slope), hn::Neg(y.weight_slope), hn::Neg(z.weight_slope)};
  const Vec under[3] = {hn::Sub(x.over, one), hn::Sub(y.over, one), hn::Sub(z.over, one)};
  for (int corner = 0; corner < 8; ++corner) {
    const bool cx = corner & 1, cy = corner >> 1 & 1, cz = corner >> 2;
    const Bits hash =
        hn::Add(hn::Add(bits(seed), cx ? x.upper : x.lower), hn::Add(cy ? y.upper : y.lower, cz ? z.upper : z.lower));
    const Vec d[3] = {cx ? under[0] : x.over, cy ? under[1] : y.over, cz ? under[2] : z.over};
    const Vec w[3] = {cx ? x.weight : rest[0], cy ? y.weight : rest[1], cz ? z.weight : rest[2]};
    const Vec slope[3] = {cx ? x.weight_slope : falling[0], cy ? y.weight_slope : falling[1],
                          cz ? z.weight_slope : falling[2]};
    add_corner<kGradient>(hash, d, w, slope, sum);
  }
  return sum;
}

// The shape of noise x, and its derivative. [docs/field.md, "Displacement"]
HWY_INLINE Vec shaped(bool ridged, Vec x, Vec& slope) {
  const double width = ridged ? kFissureWidth : kHillWidth;
  const Vec w2 = constant(width * width);
  const Vec whole = hn::MulAdd(x, x, w2);
  if (ridged) {
    const Vec share = hn::Div(w2, whole);
    slope = hn::Mul(hn::Mul(constant(4), x), hn::Div(share, whole));
    return hn::NegMulAdd(constant(2), share, constant(1));
  }
  const Vec root = hn::Sqrt(whole);
  slope = hn::Div(w2, hn::Mul(whole, root));
  return hn::Div(x, root);
}

template <bool kGradient>
void sample_octave(const NoiseOctave& octave, bool ridged, bool is_first, double scale, const PointBatch& points,
                   const FieldColumns& out) {
  const Tag d;
  const Vec3 start = points.origin * octave.frequency + octave.shift, frequency = octave.frequency / scale;
  const std::uint32_t seed = lattice_seed(octave.seed);
  const Vec height = constant(octave.height);
  const Vec factors[3] = {constant(frequency.x), constant(frequency.y), constant(frequency.z)};
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(d)) {
    const auto cell = [&](int axis, std::uint32_t factor) {
      const auto k = static_cast<std::size_t>(axis);
      return cell_at(start[axis], hn::Mul(hn::LoadU(d, points.at[k] + i), factors[k]), factor);
    };
    const Sum noise = noise_in<kGradient>(cell(0, kLatticeFactors[0]), cell(1, kLatticeFactors[1]),
                                          cell(2, kLatticeFactors[2]), seed);
    Vec slope;
    const Vec value = hn::Mul(height, shaped(ridged, noise.value, slope));
    const auto add = [&](Vec x, float* column) {
      hn::StoreU(is_first ? x : hn::Add(x, hn::LoadU(d, column + i)), d, column + i);
    };
    add(value, out.f);
    if constexpr (kGradient) {
      const Vec factor = hn::Mul(height, slope);
      add(hn::Mul(hn::Mul(factor, factors[0]), noise.x), out.gradient[0]);
      add(hn::Mul(hn::Mul(factor, factors[1]), noise.y), out.gradient[1]);
      add(hn::Mul(hn::Mul(factor, factors[2]), noise.z), out.gradient[2]);
    }
  }
}

void SampleNoise(const SolidNoise& noise, double scale, const PointBatch& points, const FieldColumns& out) {
  for (int k = 0; k < noise.octaves; ++k) {
    const NoiseOctave octave = octave_of(noise, k);
    if (out.has_gradient()) {
      sample_octave<true>(octave, noise.ridged, k == 0, scale, points, out);
    } else {
      sample_octave<false>(octave, noise.ridged, k == 0, scale, points, out);
    }
  }
}

void Displace(double amount, const FieldColumns& noise, const FieldColumns& field, std::size_t size) {
  const Tag d;
  const Vec a = constant(amount);
  for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
    const Vec f = hn::LoadU(d, field.f + i);
    const Vec factor = hn::MulAdd(a, hn::LoadU(d, noise.f + i), constant(1));
    hn::StoreU(hn::Mul(f, factor), d, field.f + i);
    if (!field.has_gradient()) continue;
    const Vec share = hn::Mul(a, f);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float* column = field.gradient[axis] + i;
      const Vec by_noise = hn::Mul(share, hn::LoadU(d, noise.gradient[axis] + i));
      hn::StoreU(hn::MulAdd(hn::LoadU(d, column), factor, by_noise), d, column);
    }
  }
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(SampleNoise);
HWY_EXPORT(Displace);

void sample_noise(const SolidNoise& noise, double scale, const PointBatch& points, const FieldColumns& out) {
  HWY_DYNAMIC_DISPATCH(SampleNoise)(noise, scale, points, out);
}

void displace(double amount, const FieldColumns& noise, const FieldColumns& field, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(Displace)(amount, noise, field, size);
}

}  // namespace barkridge
#endif
