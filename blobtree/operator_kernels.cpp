#include "blobtree/operator_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/operator_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBatchGranule>;
using Vec = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
using Fields = std::span<const FieldColumns>;

constexpr float kIso = static_cast<float>(kIsoValue);

HWY_INLINE Vec constant(float x) { return hn::Set(Tag(), x); }
HWY_INLINE Vec load(const float* column, std::size_t i) { return hn::LoadU(Tag(), column + i); }
HWY_INLINE void store(Vec x, float* column, std::size_t i) { hn::StoreU(x, Tag(), column + i); }

// Calls `combine(i)` for the points of a vector at a time.
template <typename Combine>
HWY_INLINE void for_vectors(std::size_t size, Combine combine) {
  for (std::size_t i = 0; i < size; i += hn::Lanes(Tag())) combine(i);
}

void sum(Fields fields, std::size_t size) {
  const auto add = [&](float* to, const float* from) {
    for_vectors(size, [&](std::size_t i) { store(hn::Add(load(to, i), load(from, i)), to, i); });
  };
  for (const FieldColumns& field : fields.subspan(1)) {
    add(fields[0].f, field.f);
    if (!field.has_gradient()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) add(fields[0].gradient[axis], field.gradient[axis]);
  }
}

// The first of the largest fields, or of the smallest.
template <bool kLargest>
void choose(Fields fields, std::size_t size) {
  const FieldColumns& best = fields[0];
  for (const FieldColumns& field : fields.subspan(1)) {
    for_vectors(size, [&](std::size_t i) {
      const Vec a = load(best.f, i), b = load(field.f, i);
      const Mask better = kLargest ? hn::Lt(a, b) : hn::Lt(b, a);
      store(hn::IfThenElse(better, b, a), best.f, i);
      if (!field.has_gradient()) return;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Vec chosen = hn::IfThenElse(better, load(field.gradient[axis], i), load(best.gradient[axis], i));
        store(chosen, best.gradient[axis], i);
      }
    });
  }
}

// [docs/field.md, "Difference"]
void difference(Fields fields, std::size_t size) {
  const FieldColumns &to = fields[0], &taken = fields[1];
  const Vec zero = constant(0), one = constant(1), whole = constant(2 * kIso);
  for_vectors(size, [&](std::size_t i) {
    const Vec a = load(to.f, i), b = load(taken.f, i);
    const Vec excess = hn::Max(hn::Sub(a, whole), zero);
    const Vec ramp = hn::Max(hn::NegMulAdd(b, constant(1 / kIso), one), zero);
    const Vec complement = hn::MulAdd(ramp, excess, hn::Max(hn::Sub(whole, b), zero));
    const Mask untouched = hn::Or(hn::Le(b, zero), hn::Le(a, complement));
    store(hn::IfThenElse(untouched, a, complement), to.f, i);
    if (!to.has_gradient()) return;
    const Vec weight_a = hn::IfThenElseZero(hn::Gt(excess, zero), ramp);
    const Vec weight_b = hn::Neg(hn::Add(hn::IfThenElseZero(hn::Lt(b, whole), one),
                                         hn::IfThenElseZero(hn::Gt(ramp, zero), hn::Mul(excess, constant(1 / kIso)))));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vec ga = load(to.gradient[axis], i), gb = load(taken.gradient[axis], i);
      const Vec cut = hn::MulAdd(weight_a, ga, hn::Mul(weight_b, gb));
      store(hn::IfThenElse(untouched, ga, cut), to.gradient[axis], i);
    }
  });
}

// h(x) and h'(x) for x > 0. [docs/field.md, "Precise contact"]
class Expansion {
 public:
  explicit Expansion(const ContactShape& shape) {
    const double w = shape.width, m = shape.swelling;
    width_ = static_cast<float>(w);
    cubic_ = static_cast<float>(4.0 * (w - 4.0 * m) / (w * w * w));
    square_ = static_cast<float>(4.0 * (3.0 * m - w) / (w * w));
    far_ = static_cast<float>(4.0 * m / (w * w * w));
  }

  HWY_INLINE Vec value(Vec x) const {
    const Vec near = hn::Mul(x, hn::MulAdd(x, hn::MulAdd(x, constant(cubic_), constant(square_)), constant(1)));
    const Vec rest = hn::Sub(x, constant(width_));
    const Vec far = hn::Mul(hn::Mul(constant(far_), hn::Mul(rest, rest)), hn::MulSub(constant(4), x, constant(width_)));
    return where_it_reaches(x, near, far);
  }
  HWY_INLINE Vec slope(Vec x) const {
    const Vec near = hn::MulAdd(x, hn::MulAdd(x, constant(3 * cubic_), constant(2 * square_)), constant(1));
    const Vec rest = hn::Sub(x, constant(width_));
    const Vec far = hn::Mul(hn::Mul(constant(far_), rest), hn::MulSub(constant(12), x, constant(6 * width_)));
    return where_it_reaches(x, near, far);
  }

 private:
  HWY_INLINE Vec where_it_reaches(Vec x, Vec near, Vec far) const {
    const Vec inside = hn::IfThenElse(hn::Le(x, constant(width_ / 2)), near, far);
    return hn::IfThenElseZero(hn::Lt(x, constant(width_)), inside);
  }

  float width_, cubic_, square_, far_;
};

// All compressions, clamped at the iso-value, then all expansions. Two in contact cannot fall below it but by rounding,
// which must not flatten the gradient there.
void contact(const ContactShape& shape, Fields fields, std::size_t size) {
  const Expansion expansion(shape);
  const Vec zero = constant(0), one = constant(1), iso = constant(kIso);
  for_vectors(size, [&](std::size_t i) {
    Vec highest = load(fields[0].f, i), which = zero;
    for (std::size_t k = 1; k < fields.size(); ++k) {
      const Vec f = load(fields[k].f, i);
      const Mask higher = hn::Lt(highest, f);
      highest = hn::IfThenElse(higher, f, highest);
      which = hn::IfThenElse(higher, constant(static_cast<float>(k)), which);
    }
    Vec compression = zero, expanded = zero, pressing = zero;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const Vec f = load(fields[k].f, i);
      const Mask other = hn::Ne(which, constant(static_cast<float>(k)));
      const Mask presses = hn::And(other, hn::Ge(f, iso)), nears = hn::And(other, hn::Lt(f, iso));
      compression = hn::Add(compression, hn::IfThenElseZero(presses, hn::Sub(f, iso)));
      expanded = hn::Add(expanded, hn::IfThenElseZero(nears, expansion.value(hn::Sub(iso, f))));
      pressing = hn::Add(pressing, hn::IfThenElseZero(presses, one));
    }
    const Vec pressed = hn::Sub(highest, compression);
    const Mask pressed_at_all = hn::Gt(pressing, zero);
    const Vec kept = hn::IfThenElse(pressed_at_all, hn::Max(pressed, iso), highest);
    const Vec value = hn::Add(kept, expanded);
    if (fields[0].has_gradient()) {
      const Mask flat = hn::And(hn::Gt(pressing, one), hn::Lt(pressed, iso));
      Vec g[3] = {zero, zero, zero};
      for (std::size_t k = 0; k < fields.size(); ++k) {
        const Vec f = load(fields[k].f, i);
        const Mask is_highest = hn::Eq(which, constant(static_cast<float>(k)));
        const Vec as_other = hn::IfThenElse(hn::Ge(f, iso), constant(-1), hn::Neg(expansion.slope(hn::Sub(iso, f))));
        const Vec weight = hn::IfThenElse(is_highest, one, as_other);
        const Vec used = hn::IfThenElse(hn::And(flat, hn::Ge(f, iso)), zero, weight);
        for (std::size_t axis = 0; axis < 3; ++axis)
          g[axis] = hn::MulAdd(used, load(fields[k].gradient[axis], i), g[axis]);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) store(g[axis], fields[0].gradient[axis], i);
    }
    store(value, fields[0].f, i);
  });
}

// Powers point by point: rare.
void ricci(double exponent, Fields fields, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    double powers = 0;
    for (const FieldColumns& field : fields)
      powers += std::pow(std::max(0.0, static_cast<double>(field.f[i])), exponent);
    const double result = powers > 0 ? std::pow(powers, 1 / exponent) : 0;
    double g[3] = {0, 0, 0};
    for (const FieldColumns& field : fields) {
      const double base = std::max(0.0, static_cast<double>(field.f[i]));
      if (!field.has_gradient() || base <= 0) continue;
      const double weight = std::pow(base / result, exponent - 1);
      for (std::size_t axis = 0; axis < 3; ++axis) g[axis] += weight * static_cast<double>(field.gradient[axis][i]);
    }
    fields[0].f[i] = static_cast<float>(result);
    if (!fields[0].has_gradient()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) fields[0].gradient[axis][i] = static_cast<float>(g[axis]);
  }
}

void ApplyOperator(const FieldInstruction& instruction, const FieldModel& model, Fields fields, std::size_t size) {
  using Op = FieldInstruction::Op;
  switch (instruction.op) {
    case Op::kSum:
      return sum(fields, size);
    case Op::kUnion:
      return choose<true>(fields, size);
    case Op::kIntersection:
      return choose<false>(fields, size);
    case Op::kDifference:
      return difference(fields, size);
    case Op::kContact:
      return contact(model.contacts[instruction.index], fields, size);
    case Op::kRicci:
      return ricci(model.exponents[instruction.index], fields, size);
    default:
      return;
  }
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(ApplyOperator);

void apply_operator(const FieldInstruction& instruction, const FieldModel& model, std::span<const FieldColumns> fields,
                    std::size_t size) {
  HWY_DYNAMIC_DISPATCH(ApplyOperator)(instruction, model, fields, size);
}

}  // namespace barkridge
#endif
