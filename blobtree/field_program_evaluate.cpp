#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "blobtree/cone_kernels.h"
#include "blobtree/contact.h"
#include "blobtree/field_program.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

template <bool kGradients>
void evaluate_other(const FieldProgramData::OtherData& other, const PointBatch& p, const FieldColumns& out) {
  for (std::size_t i = 0; i < p.size; ++i) {
    const Vec3 point(p.x[i], p.y[i], p.z[i]);
    const FieldSample at = std::visit([&](const auto& primitive) { return sample(primitive, point); }, other.primitive);
    out.f[i] = at.value;
    if constexpr (kGradients) {
      out.gx[i] = at.gradient.x;
      out.gy[i] = at.gradient.y;
      out.gz[i] = at.gradient.z;
    }
  }
}

// What an operator makes of its operands at one point: its value, and the weight of each operand's gradient in its own.
double combine(const FieldInstruction& instruction, const FieldProgramData& data, std::span<const double> f,
               double* weights) {
  const std::size_t count = f.size();
  std::fill_n(weights, count, 0.0);
  switch (instruction.op) {
    case Op::kSum: {
      double sum = 0;
      for (std::size_t k = 0; k < count; ++k) {
        sum += f[k];
        weights[k] = 1;
      }
      return sum;
    }
    case Op::kRicci: {
      const double n = data.exponents[instruction.index];
      double powers = 0;
      for (const double value : f) powers += std::pow(std::max(0.0, value), n);
      if (powers <= 0) return 0;
      const double result = std::pow(powers, 1 / n);
      for (std::size_t k = 0; k < count; ++k) weights[k] = std::pow(std::max(0.0, f[k]) / result, n - 1);
      return result;
    }
    case Op::kUnion:
    case Op::kIntersection: {
      const auto best =
          instruction.op == Op::kUnion ? std::max_element(f.begin(), f.end()) : std::min_element(f.begin(), f.end());
      weights[best - f.begin()] = 1;
      return *best;
    }
    case Op::kDifference: {
      const double a = f[0], b = f[1];
      const double excess = std::max(0.0, a - 2 * kIsoValue);
      const double ramp = std::max(0.0, 1 - b / kIsoValue);
      const double complement = std::max(0.0, 2 * kIsoValue - b) + ramp * excess;
      if (b <= 0 || a <= complement) {
        weights[0] = 1;
        return a;
      }
      weights[0] = excess > 0 ? ramp : 0.0;
      weights[1] = (b < 2 * kIsoValue ? -1.0 : 0.0) - (ramp > 0 ? excess / kIsoValue : 0.0);
      return complement;
    }
    case Op::kContact: {
      const ContactShape& shape = data.contacts[instruction.index];
      const std::size_t highest = static_cast<std::size_t>(std::max_element(f.begin(), f.end()) - f.begin());
      double compression = 0, expansion = 0, pressing = 0;
      std::size_t pressed_by = 0;
      for (std::size_t k = 0; k < count; ++k) {
        if (k == highest) continue;
        weights[k] = contact_effect_slope(shape, f[k]);
        if (f[k] >= kIsoValue) {
          compression += f[k] - kIsoValue;
          pressing = f[k];
          ++pressed_by;
        } else {
          expansion += contact_expansion(shape, kIsoValue - f[k]);
        }
      }
      weights[highest] = 1;
      if (pressed_by == 0) return f[highest] + expansion;
      // Written so that two in contact never fall below the iso-value by rounding.
      const double pressed =
          pressed_by == 1 ? kIsoValue + (f[highest] - pressing) : std::max(kIsoValue, f[highest] - compression);
      if (pressed_by > 1 && f[highest] - compression < kIsoValue) {
        for (std::size_t k = 0; k < count; ++k) {
          if (f[k] >= kIsoValue) weights[k] = 0;
        }
      }
      return pressed + expansion;
    }
    default:
      return 0;
  }
}

// Memory for one thread's evaluations, kept between calls.
struct Scratch {
  std::vector<double> numbers;
  std::vector<double> operands;
  std::vector<std::size_t> warps;
};

template <bool kGradients>
class Machine {
 public:
  static constexpr std::size_t kColumns = kGradients ? 4 : 1;

  Machine(const FieldProgram& program, const FieldProgramDepth& depth, std::size_t batch, Scratch& scratch)
      : program_(program), batch_(batch), scratch_(scratch) {
    scratch.numbers.resize(batch * (3 * (depth.warps + 1) + kColumns * depth.fields));
    scratch.operands.resize(2 * depth.fields + 2);
    fields_ = scratch.numbers.data() + 3 * batch * (depth.warps + 1);
  }

  double* point_column(std::size_t level, std::size_t axis) {
    return scratch_.numbers.data() + (3 * level + axis) * batch_;
  }
  FieldColumns slot(std::size_t level) {
    double* start = fields_ + kColumns * batch_ * level;
    if constexpr (kGradients) return {start, start + batch_, start + 2 * batch_, start + 3 * batch_};
    return {start, nullptr, nullptr, nullptr};
  }

  /// Runs the program on the first `size` points of level 0; the result is in slot 0.
  void run(std::size_t size) {
    std::size_t top = 0, level = 0;
    PointBatch points = points_at(0, size);
    const FieldProgramData& data = *program_.data;
    for (const FieldInstruction& instruction : program_.code) {
      switch (instruction.op) {
        case Op::kZero:
          clear(slot(top++), size);
          break;
        case Op::kCone:
          evaluate_cone(data.cones[instruction.index], points, slot(top++));
          break;
        case Op::kFadedCone:
          evaluate_faded_cone(data.faded_cones[instruction.index], points, slot(top++));
          break;
        case Op::kOther:
          evaluate_other<kGradients>(data.others[instruction.index], points, slot(top++));
          break;
        case Op::kNegate:
          negate(slot(top - 1), size);
          break;
        case Op::kEnterWarp:
          enter(data.warps[instruction.index], level, size);
          points = points_at(++level, size);
          break;
        case Op::kLeaveWarp:
          points = points_at(--level, size);
          if constexpr (kGradients) leave(data.warps[instruction.index], points, slot(top - 1));
          break;
        case Op::kSum:
          top -= instruction.count;
          for (std::size_t k = 1; k < instruction.count; ++k) add(slot(top), slot(top + k), size);
          ++top;
          break;
        default:
          top -= instruction.count;
          apply(instruction, top, size);
          ++top;
      }
    }
  }

 private:
  PointBatch points_at(std::size_t level, std::size_t size) {
    return {point_column(level, 0), point_column(level, 1), point_column(level, 2), size};
  }

  static std::array<double*, 4> columns(const FieldColumns& s) { return {s.f, s.gx, s.gy, s.gz}; }

  void clear(const FieldColumns& s, std::size_t size) {
    for (std::size_t c = 0; c < kColumns; ++c) std::fill_n(columns(s)[c], size, 0.0);
  }
  void negate(const FieldColumns& s, std::size_t size) {
    for (std::size_t c = 0; c < kColumns; ++c) {
      double* column = columns(s)[c];
      for (std::size_t i = 0; i < size; ++i) column[i] = -column[i];
    }
  }
  void add(const FieldColumns& to, const FieldColumns& from, std::size_t size) {
    for (std::size_t c = 0; c < kColumns; ++c) {
      double* sum = columns(to)[c];
      const double* summand = columns(from)[c];
      for (std::size_t i = 0; i < size; ++i) sum[i] += summand[i];
    }
  }

  void enter(const Warp& warp, std::size_t level, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      const Vec3 q = warp.map(Vec3(point_column(level, 0)[i], point_column(level, 1)[i], point_column(level, 2)[i]));
      for (int axis = 0; axis < 3; ++axis) point_column(level + 1, static_cast<std::size_t>(axis))[i] = q[axis];
    }
  }
  void leave(const Warp& warp, const PointBatch& points, const FieldColumns& s) {
    for (std::size_t i = 0; i < points.size; ++i) {
      const Mat3 jacobian = warp.map_with_jacobian({points.x[i], points.y[i], points.z[i]}).jacobian;
      const Vec3 gradient = Vec3(s.gx[i], s.gy[i], s.gz[i]) * jacobian;  // transposed Jacobian times gradient
      s.gx[i] = gradient.x;
      s.gy[i] = gradient.y;
      s.gz[i] = gradient.z;
    }
  }

  void apply(const FieldInstruction& instruction, std::size_t first, std::size_t size) {
    const std::size_t count = instruction.count;
    double* operands = scratch_.operands.data();
    double* weights = operands + count;
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k < count; ++k) operands[k] = slot(first + k).f[i];
      slot(first).f[i] = combine(instruction, *program_.data, {operands, count}, weights);
      if constexpr (kGradients) {
        for (std::size_t c = 1; c < kColumns; ++c) {
          double sum = 0;
          for (std::size_t k = 0; k < count; ++k) {
            // An operand of no weight must not count even where its gradient is not finite.
            if (weights[k] != 0) sum += weights[k] * columns(slot(first + k))[c][i];
          }
          columns(slot(first))[c][i] = sum;
        }
      }
    }
  }

  const FieldProgram& program_;
  std::size_t batch_;
  Scratch& scratch_;
  double* fields_;
};

template <bool kGradients>
void evaluate_all(const FieldProgram& program, const FieldProgramDepth& depth, std::span<const Vec3> points,
                  std::span<double> values, std::span<Vec3> gradients) {
  // As many points at once as fill the inner caches, fewer where the stack is deep.
  constexpr std::size_t kLargestBatch = 64;
  constexpr std::size_t kScratchNumbers = std::size_t{1} << 22;
  const std::size_t columns = 3 * (depth.warps + 1) + Machine<kGradients>::kColumns * depth.fields;
  const std::size_t fitting =
      std::clamp<std::size_t>(kScratchNumbers / columns, 1, std::min(kLargestBatch, points.size()));
  const std::size_t batch = (fitting + kBatchGranule - 1) / kBatchGranule * kBatchGranule;
  thread_local Scratch scratch;
  Machine<kGradients> machine(program, depth, batch, scratch);
  for (std::size_t start = 0; start < points.size(); start += batch) {
    const std::size_t size = std::min(batch, points.size() - start);
    for (std::size_t i = 0; i < size; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        machine.point_column(0, static_cast<std::size_t>(axis))[i] = points[start + i][axis];
      }
    }
    machine.run(size);
    const FieldColumns result = machine.slot(0);
    for (std::size_t i = 0; i < size; ++i) {
      values[start + i] = result.f[i];
      if constexpr (kGradients) gradients[start + i] = {result.gx[i], result.gy[i], result.gz[i]};
    }
  }
}

}  // namespace

void evaluate(const FieldProgram& program, const FieldProgramDepth& depth, std::span<const Vec3> points,
              std::span<double> values, std::span<Vec3> gradients) {
  if (points.empty()) return;
  if (program.code.empty()) {
    std::fill(values.begin(), values.end(), 0.0);
    std::fill(gradients.begin(), gradients.end(), Vec3(0));
  } else if (gradients.empty()) {
    evaluate_all<false>(program, depth, points, values, gradients);
  } else {
    evaluate_all<true>(program, depth, points, values, gradients);
  }
}

}  // namespace barkridge
