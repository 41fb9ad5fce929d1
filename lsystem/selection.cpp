#include "lsystem/selection.h"

#include <algorithm>

#include "base/random.h"

namespace barkridge {

Selector::Selector(const Skeleton& skeleton, const Selection& selection) : skeleton_(skeleton), selection_(selection) {
  std::sort(selection_.ids.begin(), selection_.ids.end());
  for (const Internode& internode : skeleton.internodes) last_step_ = std::max(last_step_, internode.birth_step);
}

bool Selector::selects(std::size_t index) const {
  const Internode& internode = skeleton_.internodes[index];
  const InternodeId id = identity(skeleton_, index);
  const std::vector<InternodeId>& ids = selection_.ids;
  return (ids.empty() || std::binary_search(ids.begin(), ids.end(), id)) &&
         selection_.order.contains(internode.order) && selection_.age.contains(last_step_ - internode.birth_step) &&
         selection_.radius.contains(internode.base_radius) &&
         (selection_.fraction >= 1 || random_unit(selection_.seed, id) < selection_.fraction);
}

}  // namespace barkridge
