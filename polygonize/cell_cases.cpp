#include "polygonize/cell_cases.h"

#include <limits>

namespace barkridge {

namespace {

using Edge = std::uint8_t;
constexpr Edge kNoEdge = 12;

struct Loop {
  int size = 0;
  std::array<Edge, 12> edges{};
};

// The edge between two neighbouring corners.
constexpr Edge edge_between(int a, int b) {
  for (Edge edge = 0; edge < 12; ++edge) {
    const int lower = edge_corner(edge);
    const int upper = lower | 1 << edge_axis(edge);
    if ((a == lower && b == upper) || (a == upper && b == lower)) return edge;
  }
  return kNoEdge;
}

// Where the surface goes on from each crossed edge. On a face seen from outside the cell, walked counter-clockwise, it
// runs from the edge by which a run of inside corners is entered to the one by which it is left, with the inside to its
// left. So where all four edges of a face are crossed, its two inside corners are kept apart: a rule that both cells at
// the face follow, since it only asks for the face's own corners.
constexpr std::array<Edge, 12> trace_faces(int cell_case) {
  std::array<Edge, 12> next{};
  next.fill(kNoEdge);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const int u = 1 << (axis + 1) % 3;
    const int v = 1 << (axis + 2) % 3;
    const int base = (face & 1) << axis;
    const std::array<int, 4> upper{base, base + u, base + u + v, base + v};
    const std::array<int, 4> lower{base, base + v, base + u + v, base + u};
    const std::array<int, 4>& corners = (face & 1) != 0 ? upper : lower;
    const auto inside = [&](int i) { return (cell_case >> corners[i & 3] & 1) != 0; };
    for (int i = 0; i < 4; ++i) {
      if (inside(i + 3) || !inside(i)) continue;
      int last = i;
      while (inside(last + 1)) ++last;
      next[edge_between(corners[(i + 3) & 3], corners[i])] = edge_between(corners[last & 3], corners[(last + 1) & 3]);
    }
  }
  return next;
}

// The midpoint of an edge in half cells.
constexpr std::array<int, 3> midpoint(Edge edge) {
  const int corner = edge_corner(edge);
  std::array<int, 3> middle{2 * (corner & 1), 2 * (corner >> 1 & 1), 2 * (corner >> 2 & 1)};
  middle[edge_axis(edge)] = 1;
  return middle;
}

constexpr int kForbidden = 1 << 20;

// What a diagonal between two edges' vertices costs: its squared length, or too much if it lay in a face.
constexpr int diagonal_cost(Edge a, Edge b) {
  const std::array<int, 3> p = midpoint(a), q = midpoint(b);
  int cost = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] == q[axis] && p[axis] != 1) return kForbidden;
    cost += (p[axis] - q[axis]) * (p[axis] - q[axis]);
  }
  return cost;
}

// The triangulation of a loop's part [first, last] with the shortest diagonals; returns their cost.
constexpr int triangulate(const Loop& loop, int first, int last, CellCase& result) {
  if (last - first < 2) return 0;
  const auto chord_cost = [&](int i, int j) { return j - i == 1 ? 0 : diagonal_cost(loop.edges[i], loop.edges[j]); };
  int best = std::numeric_limits<int>::max();
  CellCase best_result;
  for (int apex = first + 1; apex < last; ++apex) {
    CellCase candidate = result;
    int cost = chord_cost(first, apex) + chord_cost(apex, last);
    cost += triangulate(loop, first, apex, candidate);
    cost += triangulate(loop, apex, last, candidate);
    if (cost >= best) continue;
    candidate.triangles[candidate.triangle_count++] = {loop.edges[first], loop.edges[apex], loop.edges[last]};
    best = cost;
    best_result = candidate;
  }
  result = best_result;
  return best;
}

constexpr CellCase make_case(int cell_case) {
  std::array<Edge, 12> next = trace_faces(cell_case);
  CellCase result;
  for (Edge start = 0; start < 12; ++start) {
    Loop loop;
    for (Edge edge = start; next[edge] != kNoEdge;) {
      loop.edges[loop.size++] = edge;
      const Edge following = next[edge];
      next[edge] = kNoEdge;
      edge = following;
    }
    // Every loop can be triangulated without a diagonal in a face; failing to would not compile.
    if (loop.size > 0 && triangulate(loop, 0, loop.size - 1, result) >= kForbidden) throw "no triangulation";
  }
  return result;
}

constexpr std::array<CellCase, 256> make_cases() {
  std::array<CellCase, 256> cases{};
  for (int i = 0; i < 256; ++i) cases[i] = make_case(i);
  return cases;
}

}  // namespace

constexpr std::array<CellCase, 256> kCellCases = make_cases();

}  // namespace barkridge
