#include "study/patch.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace barkridge {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNone = 0xffffffff;

// Marks all vertices of the triangles that have a marked one.
std::vector<std::uint8_t> with_neighbours(const ControlMesh& mesh, const std::vector<std::uint8_t>& marks) {
  std::vector<std::uint8_t> wider = marks;
  for (const Triangle& t : mesh.triangles) {
    if (marks[t[0]] || marks[t[1]] || marks[t[2]]) wider[t[0]] = wider[t[1]] = wider[t[2]] = 1;
  }
  return wider;
}

// A triangle's limit lies in the hull of its vertices and their neighbours. So the vertices that matter are those whose
// neighbourhood may reach the box, and two rings around them.
std::vector<std::uint8_t> vertices_that_matter(const ControlMesh& mesh, const Box& box) {
  std::vector<Box> reach(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    Box whole;
    for (const std::uint32_t v : t) whole = unite(whole, Vec3(mesh.positions[v]));
    for (const std::uint32_t v : t) reach[v] = unite(reach[v], whole);
  }
  std::vector<std::uint8_t> marks(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    if (!unite(unite(reach[t[0]], reach[t[1]]), reach[t[2]]).overlaps(box)) continue;
    marks[t[0]] = marks[t[1]] = marks[t[2]] = 1;
  }
  return with_neighbours(mesh, with_neighbours(mesh, marks));
}

// Corners that share a vertex but no fan of triangles get vertices of their own, since a patch may touch itself there.
class FanSplitter {
 public:
  explicit FanSplitter(const std::vector<Triangle>& triangles) : parent_(3 * triangles.size()) {
    for (std::uint32_t c = 0; c < parent_.size(); ++c) parent_[c] = c;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> half_edges;
    const auto at = [&](std::uint32_t corner) { return triangles[corner / 3][corner % 3]; };
    const auto next = [](std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    for (std::uint32_t c = 0; c < parent_.size(); ++c) {
      if (const auto twin = half_edges.find({at(next(c)), at(c)}); twin != half_edges.end()) {
        join(c, next(twin->second));
        join(next(c), twin->second);
      }
      half_edges[{at(c), at(next(c))}] = c;
    }
  }

  std::uint32_t fan_of(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) {
    a = fan_of(a);
    b = fan_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<std::uint32_t> parent_;
};

}  // namespace

ControlMesh patch_for(const ControlMesh& mesh, const Box& box) {
  const std::vector<std::uint8_t> marks = vertices_that_matter(mesh, box);
  std::vector<Triangle> chosen;
  for (const Triangle& t : mesh.triangles) {
    if (marks[t[0]] && marks[t[1]] && marks[t[2]]) chosen.push_back(t);
  }

  ControlMesh patch;
  FanSplitter fans(chosen);
  std::vector<std::uint32_t> vertex_of_fan(3 * chosen.size(), kNone);
  std::map<std::uint32_t, std::vector<std::uint32_t>> copies;  // of vertices of the whole
  for (std::uint32_t t = 0; t < chosen.size(); ++t) {
    Triangle triangle;
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t& vertex = vertex_of_fan[fans.fan_of(3 * t + i)];
      if (vertex == kNone) {
        vertex = static_cast<std::uint32_t>(patch.positions.size());
        patch.positions.push_back(mesh.positions[chosen[t][i]]);
        copies[chosen[t][i]].push_back(vertex);
      }
      triangle[i] = vertex;
    }
    patch.triangles.push_back(triangle);
  }

  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;
  for (const Triangle& t : patch.triangles) {
    for (int i = 0; i < 3; ++i) edges[std::minmax(t[i], t[(i + 1) % 3])] = true;
  }
  for (const ControlMesh::SharpEdge& edge : mesh.sharp_edges) {
    const auto a = copies.find(edge.vertices[0]), b = copies.find(edge.vertices[1]);
    if (a == copies.end() || b == copies.end()) continue;
    for (const std::uint32_t from : a->second) {
      for (const std::uint32_t to : b->second) {
        if (edges.count(std::minmax(from, to))) patch.sharp_edges.push_back({{from, to}, edge.sharpness});
      }
    }
  }
  for (const ControlMesh::SharpVertex& corner : mesh.sharp_vertices) {
    if (const auto found = copies.find(corner.vertex); found != copies.end()) {
      for (const std::uint32_t copy : found->second) patch.sharp_vertices.push_back({copy, corner.sharpness});
    }
  }
  return patch;
}

}  // namespace barkridge
