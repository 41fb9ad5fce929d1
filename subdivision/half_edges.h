#pragma once
// Who is next to whom in a triangle mesh, as half-edges that refinement carries on by index arithmetic alone.

#include <array>
#include <cstdint>
#include <vector>

namespace barkridge {

inline constexpr std::uint32_t kNoHalfEdge = 0xffffffff;

/// The connectivity of a manifold triangle mesh. Half-edge `3 t + i` runs along triangle `t` from its corner `i` to
/// corner `i + 1`, so that the triangle is on its left.
struct HalfEdges {
  using Triangle = std::array<std::uint32_t, 3>;

  std::vector<Triangle> triangles;       ///< vertices, counter-clockwise
  std::vector<Triangle> triangle_edges;  ///< edge of half-edge `3 t + i`
  /// The half-edges along every edge; the second is `kNoHalfEdge` on a boundary.
  std::vector<std::array<std::uint32_t, 2>> edges;
  /// A half-edge that leaves each vertex: on a boundary the one along it, from which a walk against the clock meets all
  /// the vertex's triangles. `kNoHalfEdge` for a vertex of no triangle.
  std::vector<std::uint32_t> outgoing;

  std::uint32_t from(std::uint32_t h) const { return triangles[h / 3][h % 3]; }
  std::uint32_t to(std::uint32_t h) const { return from(next(h)); }
  std::uint32_t edge(std::uint32_t h) const { return triangle_edges[h / 3][h % 3]; }
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// The half-edge the other way along the same edge, or `kNoHalfEdge`.
  std::uint32_t twin(std::uint32_t h) const {
    const auto& [first, second] = edges[edge(h)];
    return first == h ? second : first;
  }
  bool is_boundary(std::uint32_t edge) const { return edges[edge][1] == kNoHalfEdge; }
};

/// Calls `visit(half_edge, vertex)` for each edge at vertex `v` against the clock: the half-edge runs along it, out of
/// `v` or, for the last edge of a vertex on a boundary, into it; the vertex is the other end. Returns whether the way
/// went around, that is, `v` is inside the mesh.
template <class Visit>
bool around(const HalfEdges& mesh, std::uint32_t v, const Visit& visit) {
  const std::uint32_t start = mesh.outgoing[v];
  if (start == kNoHalfEdge) return false;
  std::uint32_t h = start;
  for (;;) {
    visit(h, mesh.to(h));
    const std::uint32_t into = HalfEdges::previous(h), out = mesh.twin(into);
    if (out == start) return true;
    if (out == kNoHalfEdge) {
      visit(into, mesh.from(into));
      return false;
    }
    h = out;
  }
}

/// Finds the edges of a mesh. Throws `InputError` that names the first guilty element: an index not below
/// `vertex_count`, a triangle that repeats a vertex, an edge of more than two triangles or of two that disagree in
/// orientation, a vertex whose triangles are not one fan. Edges are numbered by their lower vertex, then their higher.
/// O(n log of the highest valence), in parallel.
HalfEdges half_edges(std::vector<HalfEdges::Triangle> triangles, std::size_t vertex_count);

/// How far to refine connectivity: a mesh that is refined no more needs only triangles.
enum class Refine { triangles, connectivity };

/// Splits every triangle in four: vertices keep their numbers, the vertex on edge `e` gets number
/// `outgoing.size() + e`. Triangle `t` becomes `4 t + i` at its corner `i`, which stays corner `i`, and `4 t + 3` in
/// the middle. Edge `e` becomes `2 e`, at the origin of its first half-edge, and `2 e + 1`; the three new edges of
/// triangle `t` follow, `2 edges.size() + 3 t + i` across from corner `i`. So the children of edges come first at every
/// level, and what lies on the edges of a coarse mesh is known by its number. Indices must fit in 32 bits. Parallel,
/// O(n).
HalfEdges refined(const HalfEdges& mesh, Refine what);

/// The edges `2 e` and `2 e + 1` of the refined mesh.
std::array<std::array<std::uint32_t, 2>, 2> edge_halves(const HalfEdges& mesh, std::size_t edge);

}  // namespace barkridge
