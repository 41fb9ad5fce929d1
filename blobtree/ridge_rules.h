#pragma once
// Which shape the ridge of a fork has: its own by the L-system, or that of a rule, or the one of all.

#include <span>
#include <vector>

#include "blobtree/tree.h"
#include "lsystem/selection.h"
#include "lsystem/skeleton.h"

namespace barkridge {

/// What rules go by, of two branches or more that start at one point.
struct Fork {
  /// That of the internode that carries them; 0 where the ground does.
  std::int32_t order = 0;
  /// Between the axes of the two thickest, where they start: 0 to 180.
  double angle_degrees = 0;
  /// The base radius of the second thickest over that of the thickest: above 0, at most 1.
  double radius_ratio = 1;
};

/// The fork of an internode's children, of which there are at least two; `carrier` is the internode, or none. Of
/// equally thick ones the first in the row counts as the thickest. Cost: linear in the children.
Fork fork_of(const Skeleton& skeleton, InternodeId carrier, std::span<const InternodeId> children);

/// A shape for forks whose measures all lie within closed ranges.
struct RidgeRule {
  Span orders;
  Span angles_degrees{0, 180};
  Span radius_ratios{0, 1};
  ContactShape contact;

  bool fits(const Fork& fork) const {
    return orders.contains(fork.order) && angles_degrees.contains(fork.angle_degrees) &&
           radius_ratios.contains(fork.radius_ratio);
  }
};

/// The ridge of a fork: that of the first child which has one of its own (`Internode::ridge`), else that of the last
/// rule which fits, else `otherwise`. Ridges of the skeleton's own may swell as `otherwise` may.
ContactShape contact_shape_of(const Skeleton& skeleton, InternodeId carrier, std::span<const InternodeId> children,
                              std::span<const RidgeRule> rules, const ContactShape& otherwise);

}  // namespace barkridge
