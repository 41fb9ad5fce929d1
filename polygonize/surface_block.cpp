#include "polygonize/surface_block.h"

#include <algorithm>
#include <cmath>

#include "polygonize/cell_cases.h"
#include "polygonize/crease_closing.h"

namespace barkridge {

namespace {

constexpr double kToleranceCells = 1e-5;

constexpr int kPointCount = kBlockPoints * kBlockPoints * kBlockPoints;

constexpr int point_index(int x, int y, int z) { return (z * kBlockPoints + y) * kBlockPoints + x; }

// Samples a cube of lattice points from `first` on.
void sample(const Lattice& lattice, const Field& field, const glm::ivec3& first, int points_a_side,
            std::vector<Vec3>& points, std::vector<double>& values) {
  points.clear();
  for (int z = 0; z < points_a_side; ++z) {
    for (int y = 0; y < points_a_side; ++y) {
      for (int x = 0; x < points_a_side; ++x) points.push_back(lattice.point(first + glm::ivec3(x, y, z)));
    }
  }
  values.resize(points.size());
  field.values(points, values);
}

InsideRows find_inside(const std::vector<double>& values) {
  InsideRows inside{};
  for (int row = 0; row < kBlockPoints * kBlockPoints; ++row) {
    unsigned bits = 0;
    for (int x = 0; x < kBlockPoints; ++x) {
      bits |= static_cast<unsigned>(values[row * kBlockPoints + x] >= kIsoValue) << x;
    }
    inside[row] = static_cast<std::uint16_t>(bits);
  }
  return inside;
}

// Raises the bottoms of creases among a block's samples to the iso-value.
void raise_crease_bottoms(const Lattice& lattice, const Field& with_halo, const glm::ivec3& first,
                          BlockScratch& scratch, InsideRows& inside) {
  if (!may_have_crease_bottoms(lattice, with_halo, first, inside, scratch.halo_points, scratch.halo_values)) return;
  sample(lattice, with_halo, first - kCreaseHalo, kHaloPoints, scratch.halo_points, scratch.halo_values);
  for (const glm::ivec3& bottom : crease_bottoms(scratch.halo_values)) {
    scratch.values[point_index(bottom.x, bottom.y, bottom.z)] = kIsoValue;
  }
  inside = find_inside(scratch.values);
}

bool all_equal(const InsideRows& inside) {
  constexpr std::uint16_t kFull = (1u << kBlockPoints) - 1;
  return (inside[0] == 0 || inside[0] == kFull) &&
         std::all_of(inside.begin(), inside.end(), [&](std::uint16_t row) { return row == inside[0]; });
}

// The block's crossed edges in the order of their vertices' numbers.
void collect_crossings(const Lattice& lattice, const VertexNumbers& numbers, BlockScratch& scratch) {
  scratch.crossings.clear();
  for (int z = 0; z < kBlockCells; ++z) {
    for (int y = 0; y < kBlockCells; ++y) {
      for (int axis = 0; axis < 3; ++axis) {
        for (int x = 0; x < kBlockCells; ++x) {
          if (!numbers.has(axis, x, y, z)) continue;
          const int lower = point_index(x, y, z);
          const int upper = lower + (axis == 0 ? 1 : axis == 1 ? kBlockPoints : kBlockPoints * kBlockPoints);
          EdgeCrossing& c = scratch.crossings.emplace_back();
          c.point = scratch.points[lower];
          c.axis = axis;
          c.ends[0] = {scratch.points[lower][axis], scratch.values[lower] - kIsoValue};
          c.ends[1] = {scratch.points[upper][axis], scratch.values[upper] - kIsoValue};
          c.least = c.ends[0].coordinate + lattice.margin;
          c.most = c.ends[1].coordinate - lattice.margin;
        }
      }
    }
  }
}

glm::vec3 outward_normal(const Vec3& gradient) {
  const double length = glm::length(gradient);
  return length > 0 && std::isfinite(length) ? glm::vec3(-gradient / length) : glm::vec3(0);
}

}  // namespace

VertexNumbers::VertexNumbers(const InsideRows& inside) {
  for (int z = 0; z < kBlockCells; ++z) {
    for (int y = 0; y < kBlockCells; ++y) {
      const unsigned bits = inside[z * kBlockPoints + y];
      const std::array<unsigned, 3> changes{bits ^ bits >> 1, bits ^ inside[z * kBlockPoints + y + 1],
                                            bits ^ inside[(z + 1) * kBlockPoints + y]};
      for (int axis = 0; axis < 3; ++axis) {
        const int r = row(axis, y, z);
        crossed_[r] = static_cast<std::uint8_t>(changes[axis]);  // points at x = kBlockCells are not the block's
        first_[r] = static_cast<std::uint16_t>(count_);
        count_ += kBitCounts[crossed_[r]];
      }
    }
  }
}

std::optional<SurfaceBlock> sample_block(const Lattice& lattice, const Field& field, const Field* with_halo,
                                         const glm::ivec3& coordinates, BlockScratch& scratch) {
  const glm::ivec3 first = kBlockCells * coordinates;
  sample(lattice, field, first, kBlockPoints, scratch.points, scratch.values);
  SurfaceBlock block;
  block.coordinates = coordinates;
  block.inside = find_inside(scratch.values);
  if (with_halo) raise_crease_bottoms(lattice, *with_halo, first, scratch, block.inside);
  if (all_equal(block.inside)) return std::nullopt;
  block.numbers = VertexNumbers(block.inside);
  for_each_surface_cell(block.inside, [&](int, int, int, unsigned cell_case) {
    block.triangle_count += static_cast<std::uint32_t>(kCellCases[cell_case].triangle_count);
  });
  return block;
}

void place_vertices(const Lattice& lattice, const Field& field, SurfaceBlock& block, BlockScratch& scratch) {
  collect_crossings(lattice, block.numbers, scratch);
  find_roots(field, kToleranceCells * lattice.cell_size, scratch.crossings, scratch.roots);

  const std::size_t count = scratch.crossings.size();
  scratch.points.resize(count);
  scratch.values.resize(count);
  scratch.gradients.resize(count);
  for (std::size_t i = 0; i < count; ++i) scratch.points[i] = scratch.crossings[i].point;
  field.values_and_gradients(scratch.points, scratch.values, scratch.gradients);
  block.positions.reserve(count);
  block.normals.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    block.positions.emplace_back(scratch.points[i]);
    block.normals.push_back(outward_normal(scratch.gradients[i]));
  }
}

}  // namespace barkridge
