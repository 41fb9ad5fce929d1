#include "lsystem/skeleton.h"

#include <utility>

#include "base/large_room.h"

namespace barkridge {

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
  return skeleton;
}

}  // namespace barkridge
