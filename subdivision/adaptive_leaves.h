#pragma once
// The triangles of adaptive subdivision: some of the uniform triangles of every level, with vertices on the limit
// surface.

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "subdivision/loop_level.h"

namespace barkridge {

/// A triangle that is split no further.
struct Leaf {
  std::array<std::uint32_t, 3> vertices{};
  std::array<std::uint32_t, 3> texture{};  ///< 0 without texture
  std::array<bool, 3> sharp{};             ///< whether side `i`, from corner `i` to the next, is sharp for ever
  int level = 0;
  std::uint64_t number = 0;  ///< in the uniform subdivision to its level
};

/// The vertex that splits each edge between two vertices, sorted.
struct Splits {
  struct Split {
    std::array<std::uint32_t, 2> ends;  ///< ascending
    std::uint32_t middle;
  };
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::vector<Split> all;

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t middle);
  void sort();
  /// The middle, or `kNone`.
  std::uint32_t find(std::uint32_t a, std::uint32_t b) const;
};

struct Leaves {
  std::vector<Leaf> leaves;
  Mesh surface;                         ///< vertices and texture coordinates, without triangles
  std::vector<InternodeId> internodes;  ///< as of `ControlMesh`
  std::vector<float> ages;
  Splits vertex_splits, texture_splits;
};

/// For every level the numbers of the triangles to split, ascending; each is a child of one in the level before.
using TrianglesToSplit = std::vector<std::vector<std::uint64_t>>;

/// Splits what is to be split, from the coarse level on. Beside the triangles to be split, each level holds those
/// around them, as far as their children's limits need: values are those of uniform subdivision exactly. An edge of a
/// coarse leaf that its neighbour's triangles split is in `vertex_splits` and, on both sides of a seam, in
/// `texture_splits`.
Leaves split_triangles(const LoopLevel& coarse, const TrianglesToSplit& to_split);

}  // namespace barkridge
