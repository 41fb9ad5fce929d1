// The program of some of a model's primitives: their auxiliary tree, found with a stack over their common ancestors.

#include <algorithm>
#include <optional>

#include "blobtree/field_model.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

class Assembler {
 public:
  Assembler(const FieldModel& model, FieldProgram& program)
      : model_(model), program_(program), open_(memory<Open>()), entries_(memory<Entry>()) {
    program_.clear();
    open_.clear();
    entries_.clear();
  }

  void run(std::span<const std::uint32_t> primitives) {
    for (const std::uint32_t primitive : primitives) {
      const PrimitivePlaces places = model_.places_of(primitive);
      entries_.push_back({places.first, primitive, places.second});
      if (places.second != kNoPlace) entries_.push_back({places.second, primitive, places.first});
    }
    if (entries_.size() > primitives.size()) drop_lone_twins();
    for (std::size_t first = 0; first < entries_.size();) {
      const std::uint32_t sum = model_.sums[entries_[first].place];
      std::size_t last = first + 1;
      while (last < entries_.size() && model_.sums[entries_[last].place] == sum) ++last;
      if (first > 0) close_below(common(entries_[first - 1], entries_[first]));
      if (open_.empty() || open_.back().node != sum) open_.push_back({sum, 0, program_.code.size()});
      push_primitives(std::span(entries_).subspan(first, last - first));
      first = last;
    }
    while (!open_.empty()) {
      const Open done = open_.back();
      open_.pop_back();
      finish(done);
      hand_up(done, open_.empty() ? kNoOperator : open_.back().node);
      if (!open_.empty()) ++open_.back().operands;
    }
  }

 private:
  // An operator whose operands are being written, from `start` on.
  struct Open {
    std::uint32_t node;
    std::uint32_t operands;
    std::size_t start;
  };

  // A primitive at one of its places.
  struct Entry {
    std::uint32_t place;
    std::uint32_t primitive;
    std::uint32_t twin;  // the other place
  };

  template <typename T>
  static std::vector<T>& memory() {
    thread_local std::vector<T> memory;
    return memory;
  }

  std::uint32_t depth(std::uint32_t node) const { return model_.operators[node].depth; }
  std::uint32_t common(const Entry& first, const Entry& last) const {
    return model_.ancestors.common(first.place, last.place, model_.operators);
  }

  // A primitive by itself in an operand of a union is never more than the operand that it stands in as well, if that
  // only adds to it. Of equal operands the first one counts, so the twin must come first for all bits to be the same.
  void drop_lone_twins() {
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.place < b.place; });
    std::size_t kept = 0;
    std::optional<Entry> left;  // a neighbour counts even if it has been dropped
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const Entry entry = entries_[i];
      const Entry* right = i + 1 < entries_.size() ? &entries_[i + 1] : nullptr;
      if (entry.twin >= entry.place || !is_lone_twin(entry, left ? &*left : nullptr, right)) entries_[kept++] = entry;
      left = entry;
    }
    entries_.resize(kept);
  }

  bool is_lone_twin(const Entry& entry, const Entry* left, const Entry* right) const {
    const std::uint32_t sum = model_.sums[entry.place];
    if ((left && model_.sums[left->place] == sum) || (right && model_.sums[right->place] == sum)) return false;
    const Entry twin{entry.twin, entry.primitive, entry.place};
    const std::uint32_t above = common(twin, entry);
    if (left && depth(common(*left, entry)) > depth(above)) return false;
    if (right && depth(common(entry, *right)) > depth(above)) return false;
    return only_adds(model_.sums[twin.place], above);
  }

  // Whether an operator is never less than an operand of one below it.
  bool only_adds(std::uint32_t below, std::uint32_t above) const {
    for (std::uint32_t at = below; at != above; at = model_.operators[at].parent) {
      const FieldOperator& node = model_.operators[at];
      const bool adds = node.op == Op::kSum && node.operand_count == 1;  // more where some are subtracted
      if (!adds && node.op != Op::kUnion && node.op != Op::kEnterWarp) return false;
    }
    return true;
  }

  // Finishes all open operators below `ancestor`, which is open afterwards.
  void close_below(std::uint32_t ancestor) {
    while (depth(open_.back().node) > depth(ancestor)) {
      const Open done = open_.back();
      open_.pop_back();
      finish(done);
      if (open_.empty() || depth(open_.back().node) < depth(ancestor)) open_.push_back({ancestor, 0, done.start});
      hand_up(done, open_.back().node);
      ++open_.back().operands;
    }
  }

  void push_primitives(std::span<const Entry> entries) {
    const std::size_t start = program_.cones.size();
    for (const auto [place, primitive, twin] : entries) {
      if (const FieldModel::Other* other = model_.other_at(primitive)) {
        emit(Op::kOther, 0, static_cast<std::size_t>(other - model_.others.data()));
        ++open_.back().operands;
      } else {
        program_.cones.emplace_back(primitive, model_.kinds[primitive]);
      }
    }
    if (program_.cones.size() == start) return;
    emit(Op::kCones, program_.cones.size() - start, start);
    ++open_.back().operands;
  }

  // Writes the operator over its operands. Where some are missing they are zero, which may matter.
  void finish(const Open& done) {
    const FieldOperator& node = model_.operators[done.node];
    std::uint32_t count = done.operands;
    if (node.op != Op::kSum && node.op != Op::kRicci && node.is_kept && count < node.operand_count) {
      emit(Op::kZero);
      ++count;
    }
    if (count > 1 || node.op == Op::kRicci) emit(node.op, count, node.index);
  }

  // Writes the operators between one and an open one above it that change even a lone operand.
  void hand_up(const Open& done, std::uint32_t above) {
    const FieldOperator* from = &model_.operators[done.node];
    while (from->kept_above != kNoOperator && (above == kNoOperator || depth(from->kept_above) > depth(above))) {
      const FieldOperator& node = model_.operators[from->kept_above];
      apply_alone(node, from->kept_rank, done.start);
      from = &node;
    }
  }

  void apply_alone(const FieldOperator& node, std::uint8_t rank, std::size_t start) {
    switch (node.op) {
      case Op::kNegate:
        emit(Op::kNegate);
        break;
      case Op::kDisplace:
        emit(Op::kDisplace, 1, node.index);
        break;
      case Op::kRicci:
        emit(Op::kRicci, 1, node.index);
        break;
      case Op::kDifference:
        if (rank == 0) break;
        program_.code.insert(program_.code.begin() + static_cast<std::ptrdiff_t>(start), {Op::kZero, 0, 0});
        emit(Op::kDifference, 2);
        break;
      case Op::kEnterWarp:
        program_.code.insert(program_.code.begin() + static_cast<std::ptrdiff_t>(start), {node.op, 0, node.index});
        emit(Op::kLeaveWarp, 1, node.index);
        break;
      default:
        if (node.operand_count < 2) break;
        emit(Op::kZero);
        emit(node.op, 2, node.index);
    }
  }

  void emit(Op op, std::size_t count = 0, std::size_t index = 0) {
    program_.code.push_back({op, static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(index)});
  }

  const FieldModel& model_;
  FieldProgram& program_;
  std::vector<Open>& open_;
  std::vector<Entry>& entries_;
};

}  // namespace

void assemble(const FieldModel& model, std::span<const std::uint32_t> primitives, FieldProgram& program) {
  Assembler(model, program).run(primitives);
}

}  // namespace barkridge
