#pragma once
// A skeleton as branches: what is dressed by one row of cross-sections.

#include <cstdint>
#include <span>
#include <vector>

#include "lsystem/skeleton.h"

namespace barkridge {

/// A vertex of a branch's axis.
struct BranchNode {
  Vec3 position{0};
  double radius = 0;
  double along = 0;           ///< distance from the branch's base along the axis
  InternodeId internode = 0;  ///< the one that ends here; at the branch's base the one that starts here
};

/// A row of internodes that follow each other. It has at least two nodes, and no two neighbours at the same place.
struct Branch {
  std::uint32_t first_node = 0;
  std::uint32_t node_count = 0;
  std::int32_t parent = -1;       ///< the branch that it leaves, or -1: a root, or a branch behind a gap
  std::uint32_t first_child = 0;  ///< its children's place in `Branches::children`
  std::uint32_t child_count = 0;
  double path = 0;  ///< distance from the root's base to this branch's base along the axes
};

/// All branches of a skeleton, parents before children.
struct Branches {
  std::vector<BranchNode> nodes;
  std::vector<Branch> branches;
  std::vector<std::uint32_t> children;  ///< of every branch, in the skeleton's order
  double longest_path = 0;              ///< from a root's base to a tip

  std::span<const BranchNode> axis(const Branch& branch) const {
    return std::span(nodes).subspan(branch.first_node, branch.node_count);
  }
  std::span<std::uint32_t> children_of(const Branch& branch) {
    return std::span(children).subspan(branch.first_child, branch.child_count);
  }
};

/// Where a branch ends.
enum class BranchEnd {
  kAtJoints,  ///< wherever an internode has several children, all of which start branches
  kAtTips,    ///< at joints it goes on with the thickest of the children that have its order, if there are any
};

/// The branches of a skeleton. A child is attached to its parent, and then starts at its tip, when its base is no
/// farther away from the parent's tip than that is thick; behind a wider gap it is a root. Where two internodes follow
/// each other the node has the mean of their radii. Cost: linear. Throws `InputError` that names the internode for
/// places and radii that are not finite or beyond 1e18, radii that are not above zero, internodes without length, and
/// parents that do not come before their children, as in a loop.
Branches branches_of(const Skeleton& skeleton, BranchEnd end);

/// The axis `along` units from its branch's base, between 0 and the axis' length: on the straight lines between nodes.
struct AxisPoint {
  Vec3 position{0};
  Vec3 tangent{0};
  double radius = 0;
  InternodeId internode = 0;
};
AxisPoint point_on(std::span<const BranchNode> axis, double along);

/// The axis' direction at a node: halfway between the two internodes that meet there.
Vec3 tangent_at(std::span<const BranchNode> axis, std::size_t node);

/// The ages of vertices that dress these internodes, in derivation steps: an internode's counts from its birth to the
/// youngest's.
std::vector<float> ages_of(std::span<const InternodeId> internodes, const Skeleton& skeleton);

}  // namespace barkridge
