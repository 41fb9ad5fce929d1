#pragma once
// A skeleton as points and the branches between them, trimmed at every point and merged where that leaves no room.

#include <cstdint>
#include <vector>

#include "lsystem/skeleton.h"

namespace barkridge {

/// How a branch begins or ends.
enum class HullEnd : std::uint8_t {
  kFree,   ///< nothing else is there
  kBend,   ///< one other branch of like radius goes on in nearly the same direction
  kJoint,  ///< other branches meet it
};

/// What trimming leaves of a branch at one of its two points.
struct HullTrim {
  HullEnd end = HullEnd::kFree;
  double offset = 0;  ///< along the branch, from the point to the ring, before it shrinks for want of room
  double angle = 0;   ///< of the joint's cone about the branch; joints only
  double gap = 0;     ///< to the nearest other cone; joints only
};

/// Node `i` is the tip of internode `i`, and branch `i` leads there from `up[i]`; nodes after the last internode's are
/// the bases of plants. Every node but these has one branch up and any number of branches to its children.
struct HullGraph {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> up;
  std::vector<double> base_radii, tip_radii;  ///< of branches
  std::vector<HullTrim> base_trims, tip_trims;
  std::vector<std::uint8_t> gone;  ///< branches merged away, and with them the nodes at their tips
  /// The branches that leave node `i` for its children: `children[first[i]] .. children[first[i + 1] - 1]`, by number.
  std::vector<std::uint32_t> first, children;

  std::size_t branches() const { return up.size(); }
  bool is_base(std::size_t node) const { return node >= up.size(); }
};

/// The part of its trimmed size that a branch's rings keep so that both lie on it, each within the other end's cone;
/// from 0, where a cone has no angle, to 1.
double ring_scale(const HullGraph& graph, std::size_t branch);

/// The least length that means anything: a few steps of single precision at the skeleton's largest coordinate.
double finest_length(const Skeleton& skeleton);

/// Makes the graph. While rings would be thinner than the part `thinnest_ring` of their branches, branches merge into
/// the points at their bases, in rounds in which the worst go first and neighbours do not go together; what is left is
/// trimmed. No branch is shorter or thinner than `finest_length`. Linear in internodes for each of the rounds, whose
/// number grows with the logarithm of how many branches become one point.
HullGraph hull_graph(const Skeleton& skeleton, double thinnest_ring);

}  // namespace barkridge
