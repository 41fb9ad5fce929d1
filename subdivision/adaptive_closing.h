#pragma once
// Closes the gaps between leaves of different levels.

#include <array>
#include <cstdint>
#include <vector>

#include "subdivision/adaptive_leaves.h"

namespace barkridge {

/// Triangles that together are the leaves. Each lies in one, and shares whole sides with its neighbours.
struct ClosedLeaves {
  struct Piece {
    std::array<std::uint32_t, 3> vertices{};
    std::array<std::uint32_t, 3> texture{};
    std::array<bool, 3> sharp{};  ///< whether the side after corner `i` is sharp for ever
    std::uint32_t leaf = 0;
  };
  std::vector<Piece> pieces;  ///< in the order of leaves
};

/// Divides every leaf whose sides are split by finer neighbours so that it has all their vertices: from a side that is
/// split once, to the corner across; by the shorter diagonal, where two are; and so on inwards where sides are split
/// more than once. Parallel.
ClosedLeaves close_leaves(const Leaves& leaves);

}  // namespace barkridge
