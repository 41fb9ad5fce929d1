#include "polygonize/stitch.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "base/geometry.h"
#include "polygonize/cell_cases.h"

namespace barkridge {

namespace {

auto sort_key(const glm::ivec3& c) { return std::tuple(c.z, c.y, c.x); }

// A block in order, and where its share of the mesh begins.
struct Share {
  const SurfaceBlock* block = nullptr;
  std::size_t first_vertex = 0;
  std::size_t first_triangle = 0;
};

const Share* find_share(const std::vector<Share>& shares, const glm::ivec3& coordinates) {
  const auto found = std::partition_point(shares.begin(), shares.end(), [&](const Share& share) {
    return sort_key(share.block->coordinates) < sort_key(coordinates);
  });
  return found != shares.end() && found->block->coordinates == coordinates ? &*found : nullptr;
}

// A block and those of its upper neighbours that hold the edges on its upper faces: bit a of an index, one up along
// axis a.
using Neighbourhood = std::array<const Share*, 8>;

Neighbourhood find_neighbourhood(const std::vector<Share>& shares, const Share& share) {
  Neighbourhood found{};
  for (int i = 0; i < 8; ++i) {
    found[i] = i == 0 ? &share : find_share(shares, share.block->coordinates + glm::ivec3(i & 1, i >> 1 & 1, i >> 2));
  }
  return found;
}

std::uint32_t vertex_index(const Neighbourhood& shares, int axis, int x, int y, int z) {
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(kBlockCells));
  constexpr int kMask = kBlockCells - 1;
  const Share* share = shares[(x >> kShift) | (y >> kShift) << 1 | (z >> kShift) << 2];
  const VertexNumbers* numbers = share == nullptr ? nullptr : &share->block->numbers;
  if (numbers == nullptr || !numbers->has(axis, x & kMask, y & kMask, z & kMask)) {
    throw std::logic_error("a field's bounds or restriction disagree with its values");
  }
  return static_cast<std::uint32_t>(share->first_vertex) + numbers->at(axis, x & kMask, y & kMask, z & kMask);
}

void write_share(const Share& share, const Neighbourhood& neighbourhood, Mesh& mesh) {
  const SurfaceBlock& block = *share.block;
  std::copy(block.positions.begin(), block.positions.end(), mesh.positions.data() + share.first_vertex);
  std::copy(block.normals.begin(), block.normals.end(), mesh.normals.data() + share.first_vertex);
  auto* triangle = mesh.triangles.data() + share.first_triangle;
  for_each_surface_cell(block.inside, [&](int x, int y, int z, unsigned cell_case) {
    const CellCase& surface = kCellCases[cell_case];
    for (int i = 0; i < surface.triangle_count; ++i, ++triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int edge = surface.triangles[i][k];
        const int corner = edge_corner(edge);
        (*triangle)[k] =
            vertex_index(neighbourhood, edge_axis(edge), x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
      }
    }
  });
}

// Gives vertices at which the field has no gradient the mean normal of their triangles, weighted by area.
void complete_normals(Mesh& mesh) {
  const auto lacks_normal = [](const glm::vec3& n) { return n == glm::vec3(0); };
  if (std::none_of(mesh.normals.begin(), mesh.normals.end(), lacks_normal)) return;
  std::vector<std::pair<std::uint32_t, Vec3>> sums;
  for (std::uint32_t v = 0; v < mesh.normals.size(); ++v) {
    if (lacks_normal(mesh.normals[v])) sums.emplace_back(v, Vec3(0));
  }
  for (const auto& t : mesh.triangles) {
    const Vec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    for (const std::uint32_t v : t) {
      if (!lacks_normal(mesh.normals[v])) continue;
      const auto sum = std::partition_point(sums.begin(), sums.end(), [&](const auto& s) { return s.first < v; });
      sum->second += glm::cross(b - a, c - a);
    }
  }
  for (const auto& [v, sum] : sums) {
    const double length = glm::length(sum);
    mesh.normals[v] = length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 1, 0);
  }
}

}  // namespace

Mesh stitch(const std::vector<SurfaceBlock>& blocks) {
  std::vector<Share> shares;
  shares.reserve(blocks.size());
  for (const SurfaceBlock& block : blocks) shares.push_back({&block});
  tbb::parallel_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
    return sort_key(a.block->coordinates) < sort_key(b.block->coordinates);
  });
  std::size_t vertices = 0, triangles = 0;
  for (Share& share : shares) {
    share.first_vertex = vertices;
    share.first_triangle = triangles;
    vertices += share.block->numbers.count();
    triangles += share.block->triangle_count;
  }
  Mesh mesh;
  mesh.positions.resize(vertices);
  mesh.normals.resize(vertices);
  mesh.triangles.resize(triangles);
  tbb::parallel_for(std::size_t{0}, shares.size(),
                    [&](std::size_t i) { write_share(shares[i], find_neighbourhood(shares, shares[i]), mesh); });
  complete_normals(mesh);
  return mesh;
}

}  // namespace barkridge
