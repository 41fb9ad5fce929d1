#include "mesh/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "base/geometry.h"

namespace barkridge {

namespace {

using Index = std::uint32_t;

Vec3 position(const Mesh& mesh, std::size_t vertex) { return Vec3(mesh.positions[vertex]); }

std::string describe_vertex(const Mesh& mesh, std::size_t vertex) {
  const glm::vec3& p = mesh.positions[vertex];
  return fmt::format("vertex {} at ({}, {}, {})", vertex, p.x, p.y, p.z);
}

// Counts faults of one kind and remembers where the first one is.
struct Fault {
  std::size_t count = 0;
  std::string first;

  template <typename Describe>
  void add(const Describe& describe) {
    if (count++ == 0) first = describe();
  }
};

bool is_valid(const Mesh& mesh, const std::array<Index, 3>& t) {
  const std::size_t n = mesh.positions.size();
  return t[0] < n && t[1] < n && t[2] < n && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

// The sides of all triangles as seen from each vertex: for vertex v, `neighbours(v)` has for every incident triangle
// the vertex after v and the vertex before it.
class VertexStars {
 public:
  struct Neighbour {
    Index vertex;
    Index triangle;  // counted within all valid triangles
    bool outgoing;   // the triangle runs from v to this vertex
  };

  VertexStars(std::span<const std::array<Index, 3>> triangles, std::size_t vertex_count) : start_(vertex_count + 1) {
    for (const auto& t : triangles) {
      for (const Index v : t) start_[v + 1] += 2;
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    neighbours_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto& t = triangles[i];
      for (std::size_t k = 0; k < 3; ++k) {
        neighbours_[next[t[k]]++] = {t[(k + 1) % 3], static_cast<Index>(i), true};
        neighbours_[next[t[k]]++] = {t[(k + 2) % 3], static_cast<Index>(i), false};
      }
    }
  }

  std::span<Neighbour> neighbours(std::size_t v) {
    return std::span(neighbours_).subspan(start_[v], start_[v + 1] - start_[v]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<Neighbour> neighbours_;
};

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Whether they were apart.
  bool join(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<Index> parent_;
};

struct EdgeFaults {
  Fault nonmanifold, misoriented, boundary;
  std::size_t edges = 0;
};

// Judges the edges from `v` to vertices of higher index, given v's neighbours sorted by vertex.
void judge_edges(const Mesh& mesh, Index v, std::span<const VertexStars::Neighbour> star, EdgeFaults& faults) {
  for (std::size_t i = 0, end = 0; i < star.size(); i = end) {
    const Index w = star[i].vertex;
    std::size_t outgoing = 0;
    for (end = i; end < star.size() && star[end].vertex == w; ++end) outgoing += star[end].outgoing;
    if (w < v) continue;
    ++faults.edges;
    const std::size_t uses = end - i;
    const auto describe = [&](const char* what) {
      return fmt::format("the edge from {} to {} {}", describe_vertex(mesh, v), describe_vertex(mesh, w), what);
    };
    if (uses > 2) faults.nonmanifold.add([&] { return describe("has more than two triangles"); });
    if (uses == 1) faults.boundary.add([&] { return describe("has only one triangle"); });
    if (uses == 2 && outgoing != 1) faults.misoriented.add([&] { return describe("is run along twice the same way"); });
  }
}

// Whether the triangles around a vertex are one fan, open or closed, given its neighbours sorted by vertex.
bool is_single_fan(std::span<const VertexStars::Neighbour> star, std::vector<Index>& triangles) {
  triangles.clear();
  for (const auto& n : star) {
    if (n.outgoing) triangles.push_back(n.triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  const auto local = [&](Index triangle) {
    return static_cast<Index>(std::lower_bound(triangles.begin(), triangles.end(), triangle) - triangles.begin());
  };
  DisjointSets fans(triangles.size());
  std::size_t fan_count = triangles.size();
  for (std::size_t i = 1; i < star.size(); ++i) {
    if (star[i].vertex != star[i - 1].vertex) continue;
    if (i >= 2 && star[i].vertex == star[i - 2].vertex) return false;
    fan_count -= fans.join(local(star[i - 1].triangle), local(star[i].triangle));
  }
  return fan_count == 1;
}

// Vertices that lie where one of lower index does.
Fault find_coincident_vertices(const Mesh& mesh) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 is 0
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, Index>> places;
  places.reserve(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    places.emplace_back(bits(p.x), bits(p.y), bits(p.z), static_cast<Index>(i));
  }
  std::sort(places.begin(), places.end());
  Fault fault;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const auto& [x, y, z, vertex] = places[i];
    const auto& [x0, y0, z0, vertex0] = places[i - 1];
    if (x != x0 || y != y0 || z != z0) continue;
    fault.add([&, v = vertex, v0 = vertex0] {
      return fmt::format("{} lies where vertex {} does", describe_vertex(mesh, v), v0);
    });
  }
  return fault;
}

// Adds up area and volume, and finds triangles that have none.
Fault measure(const Mesh& mesh, std::span<const std::array<Index, 3>> triangles, MeshReport& report) {
  Fault degenerate;
  // Volumes are taken from a vertex and not the origin, which may be far away.
  const Vec3 origin = triangles.empty() ? Vec3(0) : position(mesh, triangles[0][0]);
  for (const auto& t : triangles) {
    const Vec3 a = position(mesh, t[0]) - origin;
    const Vec3 b = position(mesh, t[1]) - origin;
    const Vec3 c = position(mesh, t[2]) - origin;
    const Vec3 normal = glm::cross(b - a, c - a);
    const double area = 0.5 * glm::length(normal);
    report.area += area;
    report.volume += glm::dot(a, normal) / 6.0;
    if (!(area > 0) || !std::isfinite(area)) {
      degenerate.add([&] { return fmt::format("the triangle at {} has no area", describe_vertex(mesh, t[0])); });
    }
  }
  return degenerate;
}

std::size_t count_components(std::span<const std::array<Index, 3>> triangles, std::size_t vertices, std::size_t used) {
  DisjointSets pieces(vertices);
  std::size_t components = used;
  for (const auto& t : triangles) components -= pieces.join(t[0], t[1]) + pieces.join(t[1], t[2]);
  return components;
}

}  // namespace

MeshReport examine(const Mesh& mesh) {
  MeshReport report;
  Fault invalid;
  std::vector<std::array<Index, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    if (is_valid(mesh, t)) {
      triangles.push_back(t);
    } else {
      invalid.add([&] { return fmt::format("a triangle has the vertices {}, {}, {}", t[0], t[1], t[2]); });
    }
  }

  EdgeFaults edge;
  Fault fan, unused;
  VertexStars stars(triangles, mesh.positions.size());
  std::vector<Index> scratch;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto star = stars.neighbours(v);
    if (star.empty()) {
      unused.add([&] { return describe_vertex(mesh, v) + " is in no triangle"; });
      continue;
    }
    std::sort(star.begin(), star.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    judge_edges(mesh, static_cast<Index>(v), star, edge);
    if (!is_single_fan(star, scratch)) {
      fan.add([&] { return describe_vertex(mesh, v) + " joins triangles that are not one fan"; });
    }
  }
  const Fault degenerate = measure(mesh, triangles, report);
  const Fault coincident = find_coincident_vertices(mesh);

  report.triangles = mesh.triangles.size();
  report.edges = edge.edges;
  report.invalid_triangles = invalid.count;
  report.nonmanifold_edges = edge.nonmanifold.count;
  report.misoriented_edges = edge.misoriented.count;
  report.boundary_edges = edge.boundary.count;
  report.nonmanifold_vertices = fan.count;
  report.degenerate_triangles = degenerate.count;
  report.coincident_vertices = coincident.count;
  report.unused_vertices = unused.count;
  const std::size_t used = mesh.positions.size() - unused.count;
  report.components = count_components(triangles, mesh.positions.size(), used);
  report.euler_characteristic = static_cast<std::int64_t>(used) - static_cast<std::int64_t>(edge.edges) +
                                static_cast<std::int64_t>(triangles.size());
  if (report.closed_manifold()) {
    report.genus = static_cast<std::int64_t>(report.components) - report.euler_characteristic / 2;
  }
  const std::array<const Fault*, 8> by_gravity{&invalid, &edge.nonmanifold, &edge.misoriented, &edge.boundary,
                                               &fan,     &degenerate,       &coincident,       &unused};
  for (const Fault* fault : by_gravity) {
    if (report.first_fault.empty()) report.first_fault = fault->first;
  }
  return report;
}

}  // namespace barkridge
