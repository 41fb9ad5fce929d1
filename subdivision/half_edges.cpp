#include "subdivision/half_edges.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/large_room.h"

namespace barkridge {

namespace {

using Triangle = HalfEdges::Triangle;

void check_corners(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    for (const std::uint32_t vertex : {a, b, c}) {
      if (vertex >= vertex_count) {
        throw InputError(fmt::format("triangle {} names vertex {}, but there are only {}", t, vertex, vertex_count));
      }
    }
    if (a == b || b == c || c == a) {
      throw InputError(fmt::format("triangle {} names vertex {} twice", t, a == b || a == c ? a : b));
    }
  }
}

// Half-edges sorted by the lower vertex of their edge, then the higher, then their number.
struct SortedHalfEdges {
  struct Entry {
    std::uint32_t higher, half_edge;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.higher != b.higher ? a.higher < b.higher : a.half_edge < b.half_edge;
    }
  };
  std::vector<std::size_t> first;  // of each lower vertex
  std::vector<Entry> entries;
};

SortedHalfEdges sort_half_edges(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  SortedHalfEdges sorted;
  sorted.first.assign(vertex_count + 2, 0);
  const auto each = [&](const auto& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const auto [lower, higher] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
        visit(lower, higher, static_cast<std::uint32_t>(3 * t + i));
      }
    }
  };
  // Counted two places on, so that filling moves each start to where it belongs.
  each([&](std::uint32_t lower, std::uint32_t, std::uint32_t) { ++sorted.first[lower + 2]; });
  std::partial_sum(sorted.first.begin(), sorted.first.end(), sorted.first.begin());
  resize_large(sorted.entries, triangles.size() * 3);
  each([&](std::uint32_t lower, std::uint32_t higher, std::uint32_t h) {
    sorted.entries[sorted.first[lower + 1]++] = {higher, h};
  });
  sorted.first.pop_back();
  tbb::parallel_for(std::size_t{0}, vertex_count, [&](std::size_t v) {
    std::sort(sorted.entries.begin() + static_cast<std::ptrdiff_t>(sorted.first[v]),
              sorted.entries.begin() + static_cast<std::ptrdiff_t>(sorted.first[v + 1]));
  });
  return sorted;
}

// Calls `visit(begin, end)` for the entries of each edge whose lower vertex is `v`.
template <class Visit>
void each_edge(const SortedHalfEdges& sorted, std::size_t v, const Visit& visit) {
  for (std::size_t begin = sorted.first[v], end = begin; begin < sorted.first[v + 1]; begin = end) {
    while (end < sorted.first[v + 1] && sorted.entries[end].higher == sorted.entries[begin].higher) ++end;
    visit(begin, end);
  }
}

// The first half-edge along which another of the same direction went before, or `kNoHalfEdge`.
std::uint32_t first_repeated(const HalfEdges& mesh, const SortedHalfEdges& sorted, std::size_t v) {
  std::uint32_t found = kNoHalfEdge;
  each_edge(sorted, v, [&](std::size_t begin, std::size_t end) {
    for (const bool outward : {false, true}) {
      bool seen = false;
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t h = sorted.entries[i].half_edge;
        if ((mesh.from(h) == v) != outward) continue;
        if (seen) found = std::min(found, h);
        seen = true;
      }
    }
  });
  return found;
}

// The least that `value(i)` is for any i below `count`.
template <class Value>
std::uint32_t least(std::size_t count, const Value& value) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, count), kNoHalfEdge,
      [&](const tbb::blocked_range<std::size_t>& range, std::uint32_t so_far) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) so_far = std::min(so_far, value(i));
        return so_far;
      },
      [](std::uint32_t a, std::uint32_t b) { return std::min(a, b); });
}

void number_edges(HalfEdges& mesh, const SortedHalfEdges& sorted) {
  const std::size_t vertex_count = sorted.first.size() - 1;
  std::vector<std::uint32_t> first_edge(vertex_count + 1, 0);
  tbb::parallel_for(std::size_t{0}, vertex_count, [&](std::size_t v) {
    each_edge(sorted, v, [&](std::size_t, std::size_t) { ++first_edge[v + 1]; });
  });
  std::partial_sum(first_edge.begin(), first_edge.end(), first_edge.begin());
  resize_large(mesh.edges, first_edge.back());
  resize_large(mesh.triangle_edges, mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, vertex_count, [&](std::size_t v) {
    std::uint32_t edge = first_edge[v];
    each_edge(sorted, v, [&](std::size_t begin, std::size_t end) {
      const std::uint32_t h = sorted.entries[begin].half_edge;
      mesh.edges[edge] = {h, end - begin == 2 ? sorted.entries[begin + 1].half_edge : kNoHalfEdge};
      for (std::size_t i = begin; i < end; ++i) {
        mesh.triangle_edges[sorted.entries[i].half_edge / 3][sorted.entries[i].half_edge % 3] = edge;
      }
      ++edge;
    });
  });
}

// Chooses a half-edge out of every vertex, and throws where walking from it does not meet all triangles.
void find_outgoing(HalfEdges& mesh, std::size_t vertex_count) {
  mesh.outgoing.assign(vertex_count, kNoHalfEdge);
  std::vector<std::uint32_t> valence(vertex_count, 0);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      mesh.outgoing[mesh.triangles[t][i]] = static_cast<std::uint32_t>(3 * t + i);
      ++valence[mesh.triangles[t][i]];
    }
  }
  for (const auto& [h, twin] : mesh.edges) {
    if (twin == kNoHalfEdge) mesh.outgoing[mesh.from(h)] = h;
  }
  const std::uint32_t guilty = least(vertex_count, [&](std::size_t i) {
    const auto v = static_cast<std::uint32_t>(i);
    std::uint32_t edges = 0;
    const bool inside = around(mesh, v, [&](std::uint32_t, std::uint32_t) { ++edges; });
    return valence[v] == 0 || edges == valence[v] + (inside ? 0 : 1) ? kNoHalfEdge : v;
  });
  if (guilty != kNoHalfEdge) throw InputError(fmt::format("the triangles of vertex {} are not one fan", guilty));
}

// The part of parent half-edge `h` at its origin, and the part at its end, as half-edges of the refined mesh.
std::uint32_t first_half(std::uint32_t h) { return 12 * (h / 3) + 4 * (h % 3); }
std::uint32_t second_half(std::uint32_t h) { return 12 * (h / 3) + 3 * ((h % 3 + 1) % 3) + h % 3; }

void refine_edges(const HalfEdges& mesh, HalfEdges& fine) {
  const std::size_t edge_count = mesh.edges.size(), triangle_count = mesh.triangles.size();
  resize_large(fine.edges, 2 * edge_count + 3 * triangle_count);
  resize_large(fine.outgoing, mesh.outgoing.size() + edge_count);
  tbb::parallel_for(std::size_t{0}, edge_count, [&](std::size_t e) {
    const auto halves = edge_halves(mesh, e);
    fine.edges[2 * e] = halves[0];
    fine.edges[2 * e + 1] = halves[1];
    fine.outgoing[mesh.outgoing.size() + e] = halves[1][0];
  });
  tbb::parallel_for(std::size_t{0}, triangle_count, [&](std::size_t t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t side = (i + 1) % 3;
      fine.edges[2 * edge_count + 3 * t + i] = {static_cast<std::uint32_t>(3 * (4 * t + i) + side),
                                                static_cast<std::uint32_t>(3 * (4 * t + 3) + side)};
    }
  });
  tbb::parallel_for(std::size_t{0}, mesh.outgoing.size(), [&](std::size_t v) {
    const std::uint32_t h = mesh.outgoing[v];
    fine.outgoing[v] = h == kNoHalfEdge ? h : first_half(h);
  });
}

}  // namespace

HalfEdges half_edges(std::vector<Triangle> triangles, std::size_t vertex_count) {
  check_corners(triangles, vertex_count);
  HalfEdges mesh;
  mesh.triangles = std::move(triangles);
  const SortedHalfEdges sorted = sort_half_edges(mesh.triangles, vertex_count);
  const std::uint32_t repeated = least(vertex_count, [&](std::size_t v) { return first_repeated(mesh, sorted, v); });
  if (repeated != kNoHalfEdge) {
    throw InputError(
        fmt::format("triangle {} runs along the edge from vertex {} to {}, as another does: the edge has more than two "
                    "triangles, or two that disagree in orientation",
                    repeated / 3, mesh.from(repeated), mesh.to(repeated)));
  }
  number_edges(mesh, sorted);
  find_outgoing(mesh, vertex_count);
  return mesh;
}

std::array<std::array<std::uint32_t, 2>, 2> edge_halves(const HalfEdges& mesh, std::size_t edge) {
  const auto& [h, twin] = mesh.edges[edge];
  const bool boundary = twin == kNoHalfEdge;
  return {{{first_half(h), boundary ? kNoHalfEdge : second_half(twin)},
           {second_half(h), boundary ? kNoHalfEdge : first_half(twin)}}};
}

HalfEdges refined(const HalfEdges& mesh, Refine what) {
  const std::size_t triangle_count = mesh.triangles.size();
  const auto vertex_count = static_cast<std::uint32_t>(mesh.outgoing.size());
  const auto edge_count = static_cast<std::uint32_t>(mesh.edges.size());
  HalfEdges fine;
  resize_large(fine.triangles, 4 * triangle_count);
  tbb::parallel_for(std::size_t{0}, triangle_count, [&](std::size_t t) {
    const Triangle &corners = mesh.triangles[t], &edges = mesh.triangle_edges[t];
    const std::uint32_t a = vertex_count + edges[0], b = vertex_count + edges[1], c = vertex_count + edges[2];
    fine.triangles[4 * t] = {corners[0], a, c};
    fine.triangles[4 * t + 1] = {a, corners[1], b};
    fine.triangles[4 * t + 2] = {c, b, corners[2]};
    fine.triangles[4 * t + 3] = {b, c, a};
  });
  if (what == Refine::triangles) return fine;

  refine_edges(mesh, fine);
  resize_large(fine.triangle_edges, 4 * triangle_count);
  tbb::parallel_for(std::size_t{0}, triangle_count, [&](std::size_t t) {
    const auto inner = static_cast<std::uint32_t>(2 * edge_count + 3 * t);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t edge = mesh.triangle_edges[t][i];
      const std::uint32_t reversed = mesh.edges[edge][0] == 3 * t + i ? 0 : 1;
      fine.triangle_edges[4 * t + i][i] = 2 * edge + reversed;
      fine.triangle_edges[4 * t + (i + 1) % 3][i] = 2 * edge + 1 - reversed;
      fine.triangle_edges[4 * t + i][(i + 1) % 3] = inner + static_cast<std::uint32_t>(i);
      fine.triangle_edges[4 * t + 3][(i + 1) % 3] = inner + static_cast<std::uint32_t>(i);
    }
  });
  return fine;
}

}  // namespace barkridge
