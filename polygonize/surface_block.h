#pragma once
// A block of cells through which the surface runs: signs of its lattice points and vertices on its edges.

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "polygonize/edge_roots.h"
#include "polygonize/inside_rows.h"
#include "polygonize/lattice.h"

namespace barkridge {

/// The number of bits in a byte; machines without an instruction for it are supported.
inline constexpr std::array<std::uint8_t, 256> kBitCounts = [] {
  std::array<std::uint8_t, 256> counts{};
  for (std::size_t i = 1; i < counts.size(); ++i) counts[i] = static_cast<std::uint8_t>((i & 1) + counts[i / 2]);
  return counts;
}();

/// The vertices of a block, numbered. A block has those lattice edges whose lower end is no point of its upper faces,
/// so every edge belongs to one block. Along a row of cells, vertices are in the order of x.
class VertexNumbers {
 public:
  VertexNumbers() = default;
  explicit VertexNumbers(const InsideRows& inside);

  std::uint32_t count() const { return count_; }
  /// Whether the edge from point (x, y, z), each below kBlockCells, along `axis` has a vertex.
  bool has(int axis, int x, int y, int z) const { return (crossed_[row(axis, y, z)] >> x & 1) != 0; }
  /// The vertex's number.
  std::uint32_t at(int axis, int x, int y, int z) const {
    const int r = row(axis, y, z);
    return first_[r] + kBitCounts[crossed_[r] & ((1u << x) - 1)];
  }

 private:
  static constexpr int kRows = 3 * kBlockCells * kBlockCells;
  static int row(int axis, int y, int z) { return (z * kBlockCells + y) * 3 + axis; }

  std::array<std::uint8_t, kRows> crossed_{};  // bit x: the edge from (x, y, z)
  std::array<std::uint16_t, kRows> first_{};
  std::uint32_t count_ = 0;
};

struct SurfaceBlock {
  glm::ivec3 coordinates{0};
  InsideRows inside{};
  VertexNumbers numbers;
  std::uint32_t triangle_count = 0;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // zero where the field has none
};

/// Calls `visit(x, y, z, cell_case)` for every cell of a block that the surface crosses, in a fixed order.
template <typename Visit>
void for_each_surface_cell(const InsideRows& inside, const Visit& visit) {
  for (int z = 0; z < kBlockCells; ++z) {
    for (int y = 0; y < kBlockCells; ++y) {
      const unsigned r00 = inside[z * kBlockPoints + y], r10 = inside[z * kBlockPoints + y + 1];
      const unsigned r01 = inside[(z + 1) * kBlockPoints + y], r11 = inside[(z + 1) * kBlockPoints + y + 1];
      const unsigned any = r00 | r10 | r01 | r11;
      const unsigned all = r00 & r10 & r01 & r11;
      unsigned crossed = (any | any >> 1) & ~(all & all >> 1) & ((1u << kBlockCells) - 1);
      for (; crossed != 0; crossed &= crossed - 1) {
        const int x = std::countr_zero(crossed);
        visit(x, y, z, (r00 >> x & 3) | (r10 >> x & 3) << 2 | (r01 >> x & 3) << 4 | (r11 >> x & 3) << 6);
      }
    }
  }
}

/// Memory for making blocks, used again from block to block.
struct BlockScratch {
  std::vector<Vec3> points;
  std::vector<double> values;
  std::vector<Vec3> halo_points;
  std::vector<double> halo_values;
  std::vector<Vec3> gradients;
  std::vector<EdgeCrossing> crossings;
  RootScratch roots;
};

/// Samples `field`, which need only be valid in the block's box, at the block's lattice points. Nothing when all are on
/// the same side; else a block with all but its vertices' places. The samples stay in `scratch`.
/// Given the same field for the box grown by kCreaseHalo cells, the bottoms of creases count as inside
/// (polygonize/crease_closing.h).
std::optional<SurfaceBlock> sample_block(const Lattice& lattice, const Field& field, const Field* with_halo,
                                         const glm::ivec3& coordinates, BlockScratch& scratch);

/// Finds positions and normals of the block's vertices, from the samples that `sample_block` has just left in
/// `scratch`.
void place_vertices(const Lattice& lattice, const Field& field, SurfaceBlock& block, BlockScratch& scratch);

}  // namespace barkridge
