#include "blobtree/field_model.h"

#include <algorithm>
#include <bit>

namespace barkridge {

void AncestorTable::build(std::vector<std::uint32_t> ancestors, const std::vector<FieldOperator>& operators) {
  ancestors_ = std::move(ancestors);
  highest_.clear();
  const auto higher = [&](std::uint32_t a, std::uint32_t b) { return operators[b].depth < operators[a].depth ? b : a; };
  std::vector<std::uint32_t> level;
  for (std::size_t start = 0; start < ancestors_.size(); start += kBlock) {
    std::uint32_t highest = ancestors_[start];
    for (std::size_t i = start; i < std::min(start + kBlock, ancestors_.size()); ++i) {
      highest = higher(highest, ancestors_[i]);
    }
    level.push_back(highest);
  }
  for (std::size_t reach = 1; !level.empty(); reach *= 2) {
    std::vector<std::uint32_t> next;
    for (std::size_t i = 0; i + reach < level.size(); ++i) next.push_back(higher(level[i], level[i + reach]));
    highest_.push_back(std::move(level));
    level = std::move(next);
  }
}

std::uint32_t AncestorTable::common(std::uint32_t first, std::uint32_t last,
                                    const std::vector<FieldOperator>& operators) const {
  std::uint32_t highest = ancestors_[first];
  const auto consider = [&](std::uint32_t other) {
    if (operators[other].depth < operators[highest].depth) highest = other;
  };
  const std::size_t first_block = first / kBlock + 1, last_block = last / kBlock;
  if (first_block >= last_block) {
    for (std::size_t i = first; i < last; ++i) consider(ancestors_[i]);
    return highest;
  }
  for (std::size_t i = first; i < first_block * kBlock; ++i) consider(ancestors_[i]);
  for (std::size_t i = last_block * kBlock; i < last; ++i) consider(ancestors_[i]);
  const std::size_t level = static_cast<std::size_t>(std::bit_width(last_block - first_block) - 1);
  consider(highest_[level][first_block]);
  consider(highest_[level][last_block - (std::size_t{1} << level)]);
  return highest;
}

std::size_t AncestorTable::memory() const {
  std::size_t bytes = ancestors_.capacity() * sizeof(std::uint32_t);
  for (const auto& level : highest_) bytes += level.capacity() * sizeof(std::uint32_t);
  return bytes;
}

const FieldModel::Other* FieldModel::other_at(std::uint32_t primitive) const {
  if (others.empty()) return nullptr;
  const auto found = std::lower_bound(others.begin(), others.end(), primitive,
                                      [](const Other& other, std::uint32_t p) { return other.primitive < p; });
  return found != others.end() && found->primitive == primitive ? &*found : nullptr;
}

std::size_t FieldModel::memory() const {
  return sizeof(FieldModel) + cones.capacity() * sizeof(ConeRecord) + kinds.capacity() * sizeof(ConeKind) +
         nodes.capacity() * sizeof(NodeId) + places.capacity() * sizeof(PrimitivePlaces) + supports.memory() +
         sums.capacity() * sizeof(std::uint32_t) + ancestors.memory() + operators.capacity() * sizeof(FieldOperator) +
         others.capacity() * sizeof(Other) + exponents.capacity() * sizeof(double) +
         contacts.capacity() * sizeof(ContactShape) + warps.capacity() * sizeof(Warp) +
         displacements.capacity() * sizeof(Displacement);
}

bool is_warped(const FieldModel& model, std::uint32_t sum) {
  if (model.warps.empty()) return false;
  for (std::uint32_t at = model.operators[sum].kept_above; at != kNoOperator; at = model.operators[at].kept_above) {
    if (model.operators[at].op == FieldInstruction::Op::kEnterWarp) return true;
  }
  return false;
}

bool only_takes_away(const FieldModel& model, std::uint32_t sum) {
  const FieldOperator* node = &model.operators[sum];
  bool takes_away = false;
  while (node->kept_above != kNoOperator) {
    const FieldOperator& above = model.operators[node->kept_above];
    if (above.op == FieldInstruction::Op::kNegate ||
        (above.op == FieldInstruction::Op::kDifference && node->kept_rank == 1)) {
      takes_away = !takes_away;
    }
    node = &above;
  }
  return takes_away;
}

}  // namespace barkridge
