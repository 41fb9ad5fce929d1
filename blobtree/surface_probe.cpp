#include "blobtree/surface_probe.h"

#include <algorithm>
#include <cmath>

#include "base/large_room.h"
#include "blobtree/contact.h"
#include "blobtree/field_model.h"
#include "blobtree/primitive.h"
#include "blobtree/solid_noise.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;
using Primitive = std::variant<Cone, FadedCone, Disc, Ring, Polygon>;

// A field on the stack, and what is known of the surface if it is the whole field. Its shares stand behind those of the
// fields below it.
struct Operand {
  double value = 0;
  std::size_t first_share = 0;
  double deformation = 0, ridge = 0, cut = 0;
  NodeId cutter = 0;
};

struct WarpedPlace {
  Vec3 point{0};
  Mat3 jacobian{1};
};

// The share of a ridge that lies where another child's field is `f`: see SurfaceSample::ridge.
double ridge_beside(const ContactShape& shape, double f) {
  const double x = kIsoValue - f;
  return x <= shape.width / 2 ? 1.0 : contact_expansion(shape, x) / shape.swelling;
}

// A walk over a program, of one point, which reads like that of `evaluate`.
class Walk {
 public:
  Walk(const FieldModel& model, const std::vector<Primitive>& primitives, std::vector<SurfaceShare>& shares)
      : model_(model), primitives_(primitives), shares_(shares), operands_(operands()), places_(places()) {}

  // Leaves the field and its shares.
  Operand run(const FieldProgram& program, const Vec3& point) {
    operands_.clear();
    shares_.clear();
    places_.assign(1, {point, Mat3(1)});
    for (const FieldInstruction& instruction : program.code) step(program, instruction);
    return operands_.empty() ? Operand{} : operands_.back();
  }

 private:
  static std::vector<Operand>& operands() {
    thread_local std::vector<Operand> memory;
    return memory;
  }
  static std::vector<WarpedPlace>& places() {
    thread_local std::vector<WarpedPlace> memory;
    return memory;
  }

  void step(const FieldProgram& program, const FieldInstruction& instruction) {
    switch (instruction.op) {
      case Op::kZero:
        operands_.push_back({0, shares_.size()});
        break;
      case Op::kCones:
        for (std::uint32_t i = 0; i < instruction.count; ++i) push(program.cones[instruction.index + i].cone);
        sum(instruction.count);
        break;
      case Op::kOther:
        push(model_.others[instruction.index].primitive);
        break;
      case Op::kNegate:
        negate(operands_.back());
        break;
      case Op::kDisplace: {
        const Displacement& displacement = model_.displacements[instruction.index];
        const double factor = 1 + displacement.amount * noise_here(displacement.noise);
        operands_.back().value *= factor;
        operands_.back().deformation *= factor;
        break;
      }
      case Op::kSum:
        sum(instruction.count);
        break;
      case Op::kRicci:
        ricci(instruction.count, model_.exponents[instruction.index]);
        break;
      case Op::kUnion:
        choose(instruction.count, highest(instruction.count));
        break;
      case Op::kIntersection:
        choose(instruction.count, lowest(instruction.count));
        break;
      case Op::kDifference:
        difference();
        break;
      case Op::kContact:
        contact(instruction.count, model_.contacts[instruction.index]);
        break;
      case Op::kEnterWarp: {
        const WarpedPoint to = model_.warps[instruction.index].map_with_jacobian(places_.back().point);
        places_.push_back({to.point, to.jacobian * places_.back().jacobian});
        break;
      }
      case Op::kLeaveWarp:
        places_.pop_back();
        break;
    }
  }

  // That at the point itself is kept, as most displacements share one noise.
  double noise_here(const SolidNoise& noise) {
    const bool is_warped = places_.size() > 1;
    if (!is_warped && noise_ && *noise_ == noise) return noise_value_;
    noise_ = is_warped ? nullptr : &noise;
    noise_value_ = sample(noise, places_.back().point).value;
    return noise_value_;
  }

  void push(std::uint32_t primitive) {
    const WarpedPlace& place = places_.back();
    const double value =
        std::visit([&](const auto& p) { return sample(p, place.point).value; }, primitives_[primitive]);
    operands_.push_back({value, shares_.size()});
    if (value > 0) shares_.push_back({model_.nodes[primitive], 1, place.point, place.jacobian});
  }

  // What is taken away is a cutter, whatever was cut from it. What takes away from a cutter shows nothing of itself.
  void negate(Operand& operand) {
    if (operand.value < 0) shares_.resize(operand.first_share);
    operand.value = -operand.value;
    operand.deformation = -operand.deformation;
    operand.ridge = operand.cut = 0;
  }

  std::span<Operand> top(std::size_t count) { return std::span(operands_).last(count); }
  std::size_t shares_end(const Operand* operand) const {
    return operand == &operands_.back() ? shares_.size() : (operand + 1)->first_share;
  }

  Operand* highest(std::size_t count) {
    return &*std::max_element(operands_.end() - static_cast<std::ptrdiff_t>(count), operands_.end(),
                              [](const Operand& a, const Operand& b) { return a.value < b.value; });
  }
  Operand* lowest(std::size_t count) {
    return &*std::min_element(operands_.end() - static_cast<std::ptrdiff_t>(count), operands_.end(),
                              [](const Operand& a, const Operand& b) { return a.value < b.value; });
  }

  // The primitive with the largest part in an operand.
  NodeId strongest(const Operand* operand) const {
    NodeId found = operand->cutter;
    double weight = 0;
    for (std::size_t i = operand->first_share; i < shares_end(operand); ++i) {
      if (shares_[i].weight <= weight) continue;
      weight = shares_[i].weight;
      found = shares_[i].primitive;
    }
    return found;
  }

  // Replaces the top operands by one whose shares are theirs, each operand's times its weight. An operand can be above
  // 0 without shares, where a field that is taken away is itself below 0: then the others' make up for it.
  template <typename WeightOf>
  void mix(std::size_t count, Operand result, WeightOf weight_of) {
    const std::span<Operand> mixed = top(count);
    std::size_t end = mixed.front().first_share;
    result.first_share = end;
    double total = 0;
    for (Operand& operand : mixed) {
      if (shares_end(&operand) > operand.first_share) total += weight_of(operand);
    }
    for (Operand& operand : mixed) {
      const double weight = weight_of(operand);
      const std::size_t last = shares_end(&operand);
      for (std::size_t i = operand.first_share; weight > 0 && i < last; ++i) {
        shares_[end] = shares_[i];
        shares_[end++].weight *= weight / total;
      }
      result.ridge += weight * operand.ridge;
      result.cut += weight * operand.cut;
      if (weight * operand.cut > 0) result.cutter = operand.cutter;
    }
    replace(count, result, end);
  }

  void replace(std::size_t count, const Operand& result, std::size_t share_count) {
    shares_.resize(share_count);
    operands_.resize(operands_.size() - count + 1);
    operands_.back() = result;
  }

  void choose(std::size_t count, const Operand* chosen) { choose(count, chosen, *chosen); }

  // Replaces the top operands by one that has the shares of one of them.
  void choose(std::size_t count, const Operand* chosen, Operand result) {
    const std::size_t begin = top(count).front().first_share;
    const std::size_t first = chosen->first_share, length = shares_end(chosen) - first;
    std::copy_n(shares_.begin() + static_cast<std::ptrdiff_t>(first), length,
                shares_.begin() + static_cast<std::ptrdiff_t>(begin));
    result.first_share = begin;
    replace(count, result, begin + length);
  }

  void sum(std::size_t count) {
    if (count == 1) return;
    Operand result;
    double added = 0, taken = 0, most_taken = 0;
    NodeId taker = 0;
    for (const Operand& operand : top(count)) {
      result.value += operand.value;
      result.deformation += operand.deformation;
      (operand.value > 0 ? added : taken) += std::abs(operand.value);
      if (-operand.value > most_taken) {
        most_taken = -operand.value;
        taker = strongest(&operand);
      }
    }
    mix(count, result, [added](const Operand& operand) { return operand.value > 0 ? operand.value / added : 0.0; });
    Operand& mixed = operands_.back();
    if (const double cut = std::min(1.0, taken / kIsoValue); cut > mixed.cut) {
      mixed.cut = cut;
      mixed.cutter = taker;
    }
  }

  void ricci(std::size_t count, double exponent) {
    Operand result;
    double powers = 0;
    for (const Operand& operand : top(count)) powers += std::pow(std::max(0.0, operand.value), exponent);
    result.value = std::pow(powers, 1 / exponent);
    const auto weight_of = [&](const Operand& operand) {
      return operand.value > 0 ? std::pow(operand.value / result.value, exponent) : 0.0;
    };
    for (const Operand& operand : top(count)) {
      // The derivative of the value by the operand.
      if (operand.value > 0)
        result.deformation += weight_of(operand) * result.value / operand.value * operand.deformation;
    }
    mix(count, result, weight_of);
  }

  void difference() {
    const Operand* const kept = &operands_[operands_.size() - 2];
    const Operand* const taken = &operands_.back();
    if (taken->value <= 0) return choose(2, kept);
    const double complement = std::max(0.0, 2 * kIsoValue - taken->value) +
                              std::max(0.0, kept->value - 2 * kIsoValue) * std::max(0.0, 1 - taken->value / kIsoValue);
    if (kept->value <= complement) return choose(2, kept);
    Operand result;
    result.value = complement;
    result.cut = 1;
    result.cutter = strongest(taken);
    choose(2, kept, result);
  }

  void contact(std::size_t count, const ContactShape& shape) {
    const Operand* const dominating = highest(count);
    Operand result = *dominating;
    double compression = 0, expansion = 0;
    for (const Operand& operand : top(count)) {
      if (&operand == dominating) continue;
      if (operand.value >= kIsoValue) {
        compression += operand.value - kIsoValue;
      } else {
        expansion += contact_expansion(shape, kIsoValue - operand.value);
      }
      result.ridge = std::max(result.ridge, ridge_beside(shape, operand.value));
    }
    if (compression > 0) result.value = std::max(kIsoValue, result.value - compression);
    result.value += expansion;
    result.deformation += result.value - dominating->value;
    choose(count, dominating, result);
  }

  const FieldModel& model_;
  const std::vector<Primitive>& primitives_;
  std::vector<SurfaceShare>& shares_;
  std::vector<Operand>& operands_;
  std::vector<WarpedPlace>& places_;
  const SolidNoise* noise_ = nullptr;  // whose value is kept
  double noise_value_ = 0;
};

}  // namespace

const SurfaceShare* largest_share(const SurfaceSample& sample) {
  const auto largest = std::max_element(sample.shares.begin(), sample.shares.end(),
                                        [](const auto& a, const auto& b) { return a.weight < b.weight; });
  return largest == sample.shares.end() ? nullptr : &*largest;
}

struct SurfaceProbe::Data {
  std::shared_ptr<const FieldModel> model;
  std::vector<Primitive> primitives;  // in the model's order
};

SurfaceProbe::SurfaceProbe(const BlobTree& tree) {
  check(tree);
  Data data{compile_model(tree), {}};
  reserve_large(data.primitives, data.model->nodes.size());
  for (const NodeId node : data.model->nodes) {
    std::visit(
        [&](const auto& what) {
          if constexpr (std::is_constructible_v<Primitive, decltype(what)>) data.primitives.emplace_back(what);
        },
        tree.nodes[node].what);
  }
  data_ = std::make_unique<const Data>(std::move(data));
}

SurfaceProbe::~SurfaceProbe() = default;
SurfaceProbe::SurfaceProbe(SurfaceProbe&&) noexcept = default;

void SurfaceProbe::at(const Vec3& point, SurfaceSample& sample) const {
  thread_local std::vector<std::uint32_t> found;
  thread_local FieldProgram program;
  found.clear();
  const FieldModel& model = *data_->model;
  model.supports.find({point, point}, model.nodes.size(), found);
  assemble(model, found, program);
  const Operand field = Walk(model, data_->primitives, sample.shares).run(program, point);
  sample.deformation = field.deformation;
  sample.ridge = field.ridge;
  sample.cut = field.cut;
  sample.cutter = field.cutter;
}

}  // namespace barkridge
