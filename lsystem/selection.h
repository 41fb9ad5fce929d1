#pragma once
// Which internodes a rule is for.

#include <cstdint>
#include <limits>
#include <vector>

#include "lsystem/skeleton.h"

namespace barkridge {

/// A closed range of numbers.
struct Span {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();

  bool contains(double x) const { return from <= x && x <= to; }
};

/// All that meet every condition. The default selects all.
struct Selection {
  std::vector<InternodeId> ids;  ///< their `identity`; empty for any
  Span order;                    ///< of the branch
  Span age;                      ///< derivation steps since it appeared, counted from the youngest internode
  Span radius;                   ///< of its base, in scene units
  /// The share that is drawn of what meets all else, each by itself. Drawn is by seed and identity alone.
  double fraction = 1;
  std::int64_t seed = 0;
};

/// Answers for one skeleton, which must outlive it. Cost: linear in internodes once, then logarithmic in ids each.
class Selector {
 public:
  Selector(const Skeleton& skeleton, const Selection& selection);
  bool selects(std::size_t index) const;

 private:
  const Skeleton& skeleton_;
  Selection selection_;  // its ids sorted
  std::int32_t last_step_ = 0;
};

}  // namespace barkridge
