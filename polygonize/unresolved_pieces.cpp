#include "polygonize/unresolved_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/geometry.h"

namespace barkridge {

namespace {

// Which connected piece each vertex is in: the index of one of the piece's vertices.
std::vector<std::uint32_t> pieces_of(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  // The lower index wins, so that pieces are found in the order of the vertices.
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    join(a, b);
    join(a, c);
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = parent[parent[v]];
  return parent;
}

struct Piece {
  Vec3 origin{0};  // one of its vertices, to keep rounding small
  double volume = 0;
  double area = 0;
};

}  // namespace

void remove_unresolved_pieces(Mesh& mesh, double cell_size) {
  const std::vector<std::uint32_t> piece_of = pieces_of(mesh);
  std::vector<std::uint32_t> roots;
  for (std::uint32_t v = 0; v < piece_of.size(); ++v) {
    if (piece_of[v] == v) roots.push_back(v);
  }
  if (roots.size() < 2) return;
  const auto index_of = [&](std::uint32_t vertex) {
    return static_cast<std::size_t>(std::lower_bound(roots.begin(), roots.end(), piece_of[vertex]) - roots.begin());
  };
  std::vector<Piece> pieces(roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) pieces[i].origin = Vec3(mesh.positions[roots[i]]);
  for (const auto& triangle : mesh.triangles) {
    Piece& piece = pieces[index_of(triangle[0])];
    const Vec3 a = Vec3(mesh.positions[triangle[0]]) - piece.origin;
    const Vec3 b = Vec3(mesh.positions[triangle[1]]) - piece.origin;
    const Vec3 c = Vec3(mesh.positions[triangle[2]]) - piece.origin;
    piece.volume += glm::dot(a, glm::cross(b, c)) / 6;
    piece.area += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  const Piece* largest =
      &*std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.area < b.area; });
  const auto is_unresolved = [&](std::uint32_t vertex) {
    const Piece& piece = pieces[index_of(vertex)];
    return &piece != largest && std::abs(piece.volume) < 0.4 * cell_size * piece.area;
  };

  std::erase_if(mesh.triangles, [&](const auto& triangle) { return is_unresolved(triangle[0]); });
  std::vector<std::uint32_t> moved_to(mesh.positions.size());
  std::uint32_t kept = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    moved_to[v] = kept;
    if (is_unresolved(v)) continue;
    mesh.positions[kept] = mesh.positions[v];
    if (!mesh.normals.empty()) mesh.normals[kept] = mesh.normals[v];
    ++kept;
  }
  mesh.positions.resize(kept);
  if (!mesh.normals.empty()) mesh.normals.resize(kept);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = moved_to[vertex];
  }
}

}  // namespace barkridge
