#pragma once
// Coordinates on branches: around the axis, and along it from the root on.

#include <span>
#include <vector>

#include "blobtree/tree.h"
#include "lsystem/skeleton.h"

namespace barkridge {

/// The straight space of a branch, in which a pattern stands still while the axis turns: x and z across the axis, y the
/// length of the axis from the root to here. All internodes of an axis have this space in common.
struct BranchPoint {
  Vec3 position{0};
  double around = 0;  ///< angle about the axis, from z towards x, in (-pi, pi]
  double turns = 0;   ///< the length of the axis from the root, each piece over the circumference there
  double radius = 0;  ///< of the branch there, by its taper
};

/// Where a primitive's own space lies in that of its branch.
struct BranchFrame {
  Vec3 base{0};
  Mat3 axes{1};  ///< columns: across, along, across
  double length = 0;
  double base_radius = 1, tip_radius = 1;
  double along = 0, turns = 0;  ///< at the base
  InternodeId internode = kNoInternode;
};

/// A point of a primitive's own space, where warps have brought it. Past the ends the radius stays as it is there.
BranchPoint branch_point(const BranchFrame& frame, const Vec3& point);

/// The frames of a tree's primitives. Children take on their parents' coordinates: lengths run on, and directions turn
/// with the axis by the least rotation, also along bends. Roots, and the primitives of trees written by hand, start
/// from 0. Discs, rings and polygons lie across their normal.
class BranchCoordinates {
 public:
  /// `primitives`, by internode, are the nodes of `tree` that stand for them. Cost: in proportion to the tree.
  BranchCoordinates(const BlobTree& tree, const Skeleton& skeleton, std::span<const NodeId> primitives);

  const BranchFrame& of(NodeId primitive) const { return frames_[places_[primitive]]; }
  /// Largest radius among them; 0 where there are none.
  double thickest() const { return thickest_; }

 private:
  std::vector<BranchFrame> frames_;
  std::vector<std::uint32_t> places_;  // by node, of its frame
  double thickest_ = 0;
};

}  // namespace barkridge
