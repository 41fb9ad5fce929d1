#include "lsystem/skeleton.h"

#include <fmt/format.h>

#include <utility>

#include "base/error.h"
#include "base/large_room.h"

namespace barkridge {

void check(const ScarShape& shape) {
  if (!(shape.width > 0)) throw InputError(fmt::format("a scar's width {} is not above 0", shape.width));
  if (!(shape.depth >= 0)) throw InputError(fmt::format("a scar's depth {} is negative", shape.depth));
  if (!(0 <= shape.stub && shape.stub <= 1)) {
    throw InputError(fmt::format("a scar's stub {} is outside its range: 0 <= stub <= 1", shape.stub));
  }
}

ChildTable child_table(const Skeleton& skeleton) {
  const std::size_t count = skeleton.internodes.size();
  const auto row = [&](const Internode& internode) {
    return internode.parent == kNoInternode ? count : static_cast<std::size_t>(internode.parent);
  };
  ChildTable table;
  resize_large(table.first, count + 2);
  resize_large(table.children, count);
  for (const Internode& internode : skeleton.internodes) ++table.first[row(internode) + 1];
  for (std::size_t i = 0; i <= count; ++i) table.first[i + 1] += table.first[i];
  std::vector<std::uint32_t> next = table.first;
  for (std::size_t i = 0; i < count; ++i) {
    table.children[next[row(skeleton.internodes[i])]++] = static_cast<InternodeId>(i);
  }
  return table;
}

Skeleton without_zero_lengths(Skeleton skeleton) {
  std::vector<InternodeId> new_ids;
  resize_large(new_ids, skeleton.internodes.size());
  const auto moved = [&](InternodeId id) { return id == kNoInternode ? id : new_ids[static_cast<std::size_t>(id)]; };
  const auto is_dropped = [&](InternodeId id) {
    const Internode& internode = skeleton.internodes[static_cast<std::size_t>(id)];
    return internode.base == internode.tip;
  };
  std::erase_if(skeleton.cut_ends, [&](const CutEnd& end) { return is_dropped(end.internode); });
  std::erase_if(skeleton.scars, [&](const Scar& scar) { return is_dropped(scar.internode); });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    Internode internode = skeleton.internodes[i];
    internode.parent = moved(internode.parent);
    if (internode.base == internode.tip) {
      new_ids[i] = internode.parent;
    } else {
      new_ids[i] = static_cast<InternodeId>(kept);
      skeleton.internodes[kept++] = internode;
    }
  }
  skeleton.dropped_internodes += skeleton.internodes.size() - kept;
  skeleton.internodes.resize(kept);
  for (Organ& organ : skeleton.organs) organ.internode = moved(organ.internode);
  for (ShedBranch& shed : skeleton.shed_branches) shed.parent = moved(shed.parent);
  for (CutEnd& end : skeleton.cut_ends) end.internode = moved(end.internode);
  for (Scar& scar : skeleton.scars) scar.internode = moved(scar.internode);
  return skeleton;
}

}  // namespace barkridge
