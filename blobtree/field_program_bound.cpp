#include <algorithm>
#include <cmath>
#include <limits>

#include "blobtree/contact.h"
#include "blobtree/field_model.h"
#include "blobtree/line_cones.h"
#include "blobtree/operator_bounds.h"
#include "blobtree/primitive_bounds.h"
#include "blobtree/solid_noise.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

// A field on the stack: its bounds, and where its code starts in the program being written. A field that is zero on the
// box is not live and has no code. Cones that lose their code stay in the list, unused.
struct Operand {
  FieldBounds bounds;
  std::size_t start = 0;
  bool live = false;
};

struct OpenWarp {
  Box outer_box;
  double stretch;
  double curvature;
  double jump;
  std::size_t start;
};

bool is_zero(const FieldBounds& bounds) { return bounds.value.lo == 0 && bounds.value.hi == 0; }

// Memory for one thread's walks, kept between calls.
struct Scratch {
  std::vector<Operand> stack;
  std::vector<OpenWarp> warps;
  std::vector<Operand> operands;
  std::vector<FieldBounds> children;
};

class Bounder {
 public:
  Bounder(const FieldModel& model, const Box& box, FieldProgram& rest, Scratch& scratch)
      : model_(model),
        box_(box),
        rest_(rest.code),
        cones_(rest.cones),
        stack_(scratch.stack),
        warps_(scratch.warps),
        operands_(scratch.operands),
        children_(scratch.children) {
    stack_.clear();
    warps_.clear();
  }

  /// Along parts of rays, which lie in the box, and of which is known what they meet.
  FieldBounds run(const FieldProgram& program, const LineMeeting& meeting) {
    meeting_ = &meeting;
    maps_boxes_ = !model_.others.empty() || model_.warps_noise;  // of cones all is known
    return run(program);
  }

  FieldBounds run(const FieldProgram& program) {
    for (const FieldInstruction& instruction : program.code) step(instruction, program);
    return stack_.empty() ? FieldBounds{} : stack_.back().bounds;
  }

 private:
  void step(const FieldInstruction& instruction, const FieldProgram& program) {
    switch (instruction.op) {
      case Op::kZero:
        push(instruction, {}, true);
        break;
      case Op::kCones:
        push_cones(program, instruction);
        break;
      case Op::kOther: {
        const FieldModel::Other& other = model_.others[instruction.index];
        const FieldBounds bounds = bounds_where_supported(other.support, box_, [&](const Box& part) {
          return std::visit([&](const auto& shape) { return bounds_of(shape, part); }, other.shape);
        });
        push(instruction, through_warps(bounds), !is_zero(bounds));
        break;
      }
      case Op::kNegate:
        negate(instruction);
        break;
      case Op::kDisplace:
        displace(instruction);
        break;
      case Op::kEnterWarp:
        enter(instruction);
        break;
      case Op::kLeaveWarp:
        leave(instruction);
        break;
      case Op::kSum:
      case Op::kRicci: {
        keep_live(instruction.count);
        // (F^n)^(1/n) is not F to the bit, so a lone operand of a Ricci blend stays in its node.
        finish(instruction, instruction.op == Op::kRicci);
        break;
      }
      case Op::kUnion: {
        keep_live_or_zero(instruction.count);
        const double lowest = highest_lower_bound();
        drop_if([&](const FieldBounds& b) { return b.value.hi < lowest; });
        finish(instruction);
        break;
      }
      case Op::kContact: {
        keep_live_or_zero(instruction.count);
        // A child too weak to deform the others, and never the highest, does nothing.
        const double lowest = highest_lower_bound();
        const double weakest = kIsoValue - model_.contacts[instruction.index].width;
        drop_if([&](const FieldBounds& b) { return b.value.hi < lowest && b.value.hi <= weakest; });
        finish(instruction);
        break;
      }
      case Op::kIntersection:
        intersection(instruction);
        break;
      case Op::kDifference:
        difference(instruction);
        break;
    }
  }

  void push_cones(const FieldProgram& program, const FieldInstruction& instruction) {
    FieldBounds sum{{0, 0}, 0, {0, 0}};
    const std::size_t first = cones_.size();
    for (std::size_t k = instruction.index; k < instruction.index + instruction.count; ++k) {
      const ConeReference& reference = program.cones[k];
      const ConeBounds bounds = bounds_of_cone(reference);
      if (is_zero(bounds.field)) continue;
      add(sum, bounds.field);
      cones_.emplace_back(reference.cone, bounds.steady ? ConeKind::kSteady : static_cast<ConeKind>(reference.kind));
    }
    const std::size_t count = cones_.size() - first;
    push({Op::kCones, static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(first)}, sum, count > 0);
  }

  ConeBounds bounds_of_cone(const ConeReference& reference) {
    if (meeting_) return met(reference.cone);
    ConeBounds bounds =
        bounds_of(model_.cones[reference.cone], static_cast<ConeKind>(reference.kind), model_.units, box_);
    bounds.field = through_warps(bounds.field);
    return bounds;
  }

  // Mostly programs come to them in their order.
  const ConeBounds& met(std::uint32_t cone) {
    const std::vector<std::uint32_t>& primitives = meeting_->primitives;
    if (next_met_ == primitives.size() || primitives[next_met_] != cone) {
      const auto at = std::lower_bound(primitives.begin(), primitives.end(), cone);
      next_met_ = static_cast<std::size_t>(at - primitives.begin());
    }
    return meeting_->cones[next_met_++];
  }

  void push(const FieldInstruction& instruction, const FieldBounds& bounds, bool live) {
    stack_.push_back({bounds, rest_.size(), live});
    if (live) rest_.push_back(instruction);
  }

  void negate(const FieldInstruction& instruction) {
    Operand& top = stack_.back();
    if (!top.live) return;
    top.bounds.value = {-top.bounds.value.hi, -top.bounds.value.lo};
    top.bounds.second = {-top.bounds.second.hi, -top.bounds.second.lo};
    rest_.push_back(instruction);
  }

  void displace(const FieldInstruction& instruction) {
    Operand& top = stack_.back();
    if (!top.live) return;
    const Displacement& displacement = model_.displacements[instruction.index];
    top.bounds = displaced(top.bounds, displacement.amount, bounds_of_noise(displacement.noise));
    rest_.push_back(instruction);
  }

  // Those in the program's own box are kept, as most displacements share one noise.
  FieldBounds bounds_of_noise(const SolidNoise& noise) {
    if (warps_.empty() && noise_ && *noise_ == noise) return noise_bounds_;
    noise_ = warps_.empty() ? &noise : nullptr;
    noise_bounds_ = through_warps(bounds_of(noise, box_.center(), glm::length(box_.half_extent())));
    return noise_bounds_;
  }

  void enter(const FieldInstruction& instruction) {
    const WarpedBox warped = maps_boxes_ ? model_.warps[instruction.index].map(box_) : WarpedBox{};
    warps_.push_back({box_, warped.stretch, warped.curvature, warped.jump, rest_.size()});
    rest_.push_back(instruction);
    box_ = warped.box;
  }

  // Bounds of a primitive hold through all warps above it from the start.
  FieldBounds through_warps(FieldBounds bounds) const {
    for (auto warp = warps_.rbegin(); warp != warps_.rend(); ++warp) {
      bounds = through_warp(bounds, warp->stretch, warp->curvature, warp->jump);
    }
    return bounds;
  }

  void leave(const FieldInstruction& instruction) {
    const OpenWarp warp = warps_.back();
    warps_.pop_back();
    box_ = warp.outer_box;
    Operand& top = stack_.back();
    top.start = warp.start;
    if (top.live) {
      rest_.push_back(instruction);
    } else {
      rest_.resize(warp.start);
    }
  }

  // ---- Operators. Their operands move from the stack to `operands_`; those that drop out lose their code.

  void take(std::size_t count) {
    operands_.assign(stack_.end() - static_cast<std::ptrdiff_t>(count), stack_.end());
    stack_.resize(stack_.size() - count);
    start_ = operands_.front().start;
  }

  void keep_live(std::size_t count) {
    take(count);
    std::erase_if(operands_, [](const Operand& o) { return !o.live; });
  }

  // For operators in which a zero operand matters where the others are negative.
  void keep_live_or_zero(std::size_t count) {
    keep_live(count);
    if (operands_.size() == count || operands_.empty()) return;
    if (std::any_of(operands_.begin(), operands_.end(), [](const Operand& o) { return o.bounds.value.lo < 0; })) {
      push_zero_operand();
    }
  }

  void push_zero_operand() {
    operands_.push_back({{}, rest_.size(), true});
    rest_.push_back({Op::kZero, 0, 0});
  }

  double highest_lower_bound() const {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Operand& operand : operands_) highest = std::max(highest, operand.bounds.value.lo);
    return highest;
  }

  template <typename Condition>
  void drop_if(Condition condition) {
    for (std::size_t k = operands_.size(); k-- > 0;) {
      if (!condition(operands_[k].bounds)) continue;
      const std::size_t from = operands_[k].start;
      const std::size_t to = k + 1 < operands_.size() ? operands_[k + 1].start : rest_.size();
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(from), rest_.begin() + static_cast<std::ptrdiff_t>(to));
      for (std::size_t later = k + 1; later < operands_.size(); ++later) operands_[later].start -= to - from;
      operands_.erase(operands_.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }

  void finish(FieldInstruction instruction, bool keep_when_single = false) {
    if (operands_.empty()) {
      rest_.resize(start_);
      stack_.push_back({{}, start_, false});
      return;
    }
    if (operands_.size() == 1 && !keep_when_single) {
      stack_.push_back({operands_[0].bounds, start_, true});
      return;
    }
    children_.clear();
    for (const Operand& operand : operands_) children_.push_back(operand.bounds);
    instruction.count = static_cast<std::uint32_t>(operands_.size());
    rest_.push_back(instruction);
    stack_.push_back({bounds_of_node(instruction), start_, true});
  }

  FieldBounds bounds_of_node(const FieldInstruction& instruction) const {
    switch (instruction.op) {
      case Op::kSum:
        return bounds_of(Sum{}, children_);
      case Op::kRicci:
        return bounds_of(Ricci{model_.exponents[instruction.index]}, children_);
      case Op::kUnion:
        return bounds_of(Union{}, children_);
      case Op::kIntersection:
        return bounds_of(Intersection{}, children_);
      case Op::kDifference:
        return bounds_of(Difference{}, children_);
      case Op::kContact:
        return bounds_of(Contact{model_.contacts[instruction.index]}, children_);
      default:
        return {};
    }
  }

  void intersection(const FieldInstruction& instruction) {
    const std::size_t count = instruction.count;
    keep_live(count);
    if (operands_.size() < count) {
      // min(0, ..) is 0 unless another operand is negative.
      drop_if([](const FieldBounds& b) { return b.value.lo >= 0; });
      if (!operands_.empty()) push_zero_operand();
    }
    double highest = std::numeric_limits<double>::infinity();
    for (const Operand& operand : operands_) highest = std::min(highest, operand.bounds.value.hi);
    drop_if([&](const FieldBounds& b) { return b.value.lo > highest; });
    finish(instruction);
  }

  void difference(const FieldInstruction& instruction) {
    take(2);
    const Operand a = operands_[0], b = operands_[1];
    // Zero without anything zero; whole where nothing is taken away, or where the complement is never the smaller.
    if (!a.live) {
      operands_.clear();
    } else if (!b.live || b.bounds.value.hi <= 0 || a.bounds.value.hi <= 2 * kIsoValue - b.bounds.value.hi) {
      operands_.pop_back();
      rest_.resize(b.start);
    }
    finish(instruction);
  }

  const FieldModel& model_;
  Box box_;
  std::vector<FieldInstruction>& rest_;
  std::vector<ConeReference>& cones_;
  std::vector<Operand>& stack_;
  std::vector<OpenWarp>& warps_;
  std::vector<Operand>& operands_;
  std::vector<FieldBounds>& children_;
  std::size_t start_ = 0;

  const SolidNoise* noise_ = nullptr;  // whose bounds these are
  FieldBounds noise_bounds_;

  const LineMeeting* meeting_ = nullptr;
  std::size_t next_met_ = 0;
  bool maps_boxes_ = true;
};

}  // namespace

FieldBounds bound(const FieldModel& model, const FieldProgram& program, const Box& box, FieldProgram* rest) {
  thread_local Scratch scratch;
  thread_local FieldProgram discarded;
  FieldProgram& out = rest ? *rest : discarded;
  out.clear();
  return Bounder(model, box, out, scratch).run(program);
}

FieldBounds bound_along(const FieldModel& model, const FieldProgram& program, const LineMeeting& meeting,
                        const RayBundle& bundle, FieldProgram& rest) {
  thread_local Scratch scratch;
  rest.clear();
  Box box;
  for_each_lane(meeting.rays, [&](std::size_t lane) {
    const Ray ray = bundle.ray(lane);
    box = unite(unite(box, ray.at(meeting.reach.lo[lane])), ray.at(meeting.reach.hi[lane]));
  });
  return Bounder(model, box, rest, scratch).run(program, meeting);
}

}  // namespace barkridge
