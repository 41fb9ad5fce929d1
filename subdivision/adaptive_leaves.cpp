#include "subdivision/adaptive_leaves.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>

#include "subdivision/sheet_part.h"

namespace barkridge {

namespace {

constexpr std::uint32_t kNone = Splits::kNone;

// Some triangles of a level of uniform subdivision.
struct Level {
  LoopLevel mesh;
  std::vector<std::uint64_t> numbers;  // of the triangles, ascending
  std::vector<bool> leaf_or_split;     // whether a triangle is there for itself, not only to surround others
  // Where vertices and texture coordinates are in the result; `kNone` for those that are not.
  std::vector<std::uint32_t> vertices, texture;
};

std::vector<std::uint32_t> count_up(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

Level first_level(const LoopLevel& coarse) {
  Level level;
  level.mesh = coarse;
  level.numbers.resize(coarse.surface.mesh.triangles.size());
  std::iota(level.numbers.begin(), level.numbers.end(), std::uint64_t{0});
  level.leaf_or_split.assign(level.numbers.size(), true);
  level.vertices = count_up(coarse.surface.values.size());
  level.texture = count_up(coarse.charts.values.size());
  return level;
}

// Puts the limits of the vertices that are new in the result, those from number `known` on, into it.
void add_limits(const Sheet<glm::vec3>& sheet, const std::vector<std::uint32_t>& places, std::size_t known,
                std::size_t count, Mesh& mesh) {
  mesh.positions.resize(count);
  mesh.normals.resize(count);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    if (places[i] == kNone || places[i] < known) return;
    const LimitPoint point = limit_point(sheet, static_cast<std::uint32_t>(i));
    mesh.positions[places[i]] = point.position;
    mesh.normals[places[i]] = point.normal;
  });
}

void add_limits(const Sheet<glm::vec2>& sheet, const std::vector<std::uint32_t>& places, std::size_t known,
                std::size_t count, std::vector<glm::vec2>& texture) {
  texture.resize(count);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    if (places[i] == kNone || places[i] < known) return;
    texture[places[i]] = limit_texture(sheet, static_cast<std::uint32_t>(i));
  });
}

// Puts what vertices that are new in the result carry, `values`, into it; nothing where nothing is carried.
template <class Value>
void add_carried(const std::vector<Value>& values, const std::vector<std::uint32_t>& places, std::size_t known,
                 std::size_t count, std::vector<Value>& result) {
  if (values.empty()) return;
  result.resize(count);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] != kNone && places[i] >= known) result[places[i]] = values[i];
  }
}

void add_vertices(const Level& level, std::size_t known, std::size_t count, Leaves& result) {
  add_limits(level.mesh.surface, level.vertices, known, count, result.surface);
  add_carried(level.mesh.internodes, level.vertices, known, count, result.internodes);
  add_carried(level.mesh.ages, level.vertices, known, count, result.ages);
}

template <class Value>
std::vector<Value> picked(const std::vector<Value>& values, const std::vector<std::uint32_t>& which) {
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(which.size());
  for (const std::uint32_t i : which) result.push_back(values[i]);
  return result;
}

// Which of the level's triangles are to be split.
std::vector<bool> find_splits(const Level& level, const std::vector<std::uint64_t>& to_split) {
  std::vector<bool> split(level.numbers.size(), false);
  std::size_t next = 0;
  for (std::size_t t = 0; t < split.size(); ++t) {
    while (next < to_split.size() && to_split[next] < level.numbers[t]) ++next;
    split[t] = level.leaf_or_split[t] && next < to_split.size() && to_split[next] == level.numbers[t];
  }
  return split;
}

void add_leaves(const Level& level, const std::vector<bool>& split, int number_of_level, std::vector<Leaf>& leaves) {
  const Sheet<glm::vec3>& surface = level.mesh.surface;
  const bool textured = !level.texture.empty();
  for (std::size_t t = 0; t < split.size(); ++t) {
    if (split[t] || !level.leaf_or_split[t]) continue;
    Leaf leaf;
    for (std::size_t i = 0; i < 3; ++i) {
      leaf.vertices[i] = level.vertices[surface.mesh.triangles[t][i]];
      if (textured) leaf.texture[i] = level.texture[level.mesh.charts.mesh.triangles[t][i]];
      leaf.sharp[i] = surface.sharpness_of_edge(surface.mesh.triangle_edges[t][i]) == kInfinitelySharp;
    }
    leaf.level = number_of_level;
    leaf.number = level.numbers[t];
    leaves.push_back(leaf);
  }
}

// Which of the surface's edges are split, and which of the charts', on both sides.
struct SplitEdges {
  std::vector<bool> surface, charts;
};

SplitEdges find_split_edges(const LoopLevel& mesh, const std::vector<bool>& split) {
  SplitEdges edges{std::vector<bool>(mesh.surface.mesh.edges.size(), false),
                   std::vector<bool>(mesh.charts.mesh.edges.size(), false)};
  const bool textured = !mesh.charts.mesh.edges.empty();
  for (std::size_t t = 0; t < split.size(); ++t) {
    if (!split[t]) continue;
    for (const std::uint32_t edge : mesh.surface.mesh.triangle_edges[t]) {
      edges.surface[edge] = true;
      for (const std::uint32_t h : mesh.surface.mesh.edges[edge]) {
        if (textured && h != kNoHalfEdge) edges.charts[mesh.charts.mesh.edge(h)] = true;
      }
    }
  }
  return edges;
}

// The triangles that share a vertex with one that is split, and those.
std::vector<std::uint32_t> surroundings(const HalfEdges& mesh, const std::vector<bool>& split) {
  std::vector<bool> near(mesh.outgoing.size(), false);
  for (std::size_t t = 0; t < split.size(); ++t) {
    if (!split[t]) continue;
    for (const std::uint32_t v : mesh.triangles[t]) near[v] = true;
  }
  std::vector<std::uint32_t> result;
  for (std::size_t t = 0; t < split.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (near[a] || near[b] || near[c]) result.push_back(static_cast<std::uint32_t>(t));
  }
  return result;
}

// The places of the next level's vertices in the result: those of before, then new ones at edges that are split, which
// are counted from `count` on and noted as splits.
template <class Value>
std::vector<std::uint32_t> next_places(const Sheet<Value>& sheet, const SheetPart<Value>& part,
                                       const std::vector<std::uint32_t>& places, const std::vector<bool>& split_edges,
                                       std::size_t& count, Splits& splits) {
  std::vector<std::uint32_t> next;
  next.reserve(part.vertices.size() + part.edges.size());
  for (const std::uint32_t v : part.vertices) next.push_back(places[v]);
  for (const std::uint32_t e : part.edges) {
    next.push_back(split_edges[e] ? static_cast<std::uint32_t>(count++) : kNone);
    if (!split_edges[e]) continue;
    const std::uint32_t h = sheet.mesh.edges[e][0];
    splits.add(places[sheet.mesh.from(h)], places[sheet.mesh.to(h)], next.back());
  }
  return next;
}

// Splits the triangles, and puts vertices that this makes into the result.
Level next_level(const Level& level, const std::vector<bool>& split, Leaves& result) {
  const Sheet<glm::vec3>& surface = level.mesh.surface;
  const Sheet<glm::vec2>& charts = level.mesh.charts;
  const std::vector<std::uint32_t> kept = surroundings(surface.mesh, split);
  const SplitEdges split_edges = find_split_edges(level.mesh, split);
  Level next;

  SheetPart<glm::vec3> part = part_of(surface, kept);
  SheetPart<glm::vec2> chart_part;
  if (!charts.mesh.triangles.empty()) chart_part = part_of(charts, kept);
  const std::size_t known = result.surface.positions.size();
  std::size_t count = known;
  next.vertices = next_places(surface, part, level.vertices, split_edges.surface, count, result.vertex_splits);
  const std::size_t known_texture = result.surface.texture.size();
  std::size_t texture_count = known_texture;
  next.texture =
      next_places(charts, chart_part, level.texture, split_edges.charts, texture_count, result.texture_splits);

  next.mesh = refined(LoopLevel{std::move(part.sheet), std::move(chart_part.sheet),
                                picked(level.mesh.internodes, part.vertices), picked(level.mesh.ages, part.vertices)},
                      Refine::connectivity);
  add_vertices(next, known, count, result);
  add_limits(next.mesh.charts, next.texture, known_texture, texture_count, result.surface.texture);

  for (const std::uint32_t t : kept) {
    for (std::uint64_t child = 0; child < 4; ++child) {
      next.numbers.push_back(4 * level.numbers[t] + child);
      next.leaf_or_split.push_back(split[t]);
    }
  }
  return next;
}

}  // namespace

void Splits::add(std::uint32_t a, std::uint32_t b, std::uint32_t middle) {
  all.push_back({{std::min(a, b), std::max(a, b)}, middle});
}

void Splits::sort() {
  tbb::parallel_sort(all.begin(), all.end(), [](const Split& a, const Split& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.middle < b.middle;
  });
}

std::uint32_t Splits::find(std::uint32_t a, std::uint32_t b) const {
  const std::array<std::uint32_t, 2> ends{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(all.begin(), all.end(), ends,
                                      [](const Split& s, const auto& wanted) { return s.ends < wanted; });
  return found != all.end() && found->ends == ends ? found->middle : kNone;
}

Leaves split_triangles(const LoopLevel& coarse, const TrianglesToSplit& to_split) {
  Leaves result;
  Level level = first_level(coarse);
  add_vertices(level, 0, level.vertices.size(), result);
  add_limits(level.mesh.charts, level.texture, 0, level.texture.size(), result.surface.texture);
  for (std::size_t i = 0;; ++i) {
    const std::vector<bool> split =
        find_splits(level, i < to_split.size() ? to_split[i] : std::vector<std::uint64_t>());
    add_leaves(level, split, static_cast<int>(i), result.leaves);
    if (std::find(split.begin(), split.end(), true) == split.end()) break;
    level = next_level(level, split, result);
  }
  result.vertex_splits.sort();
  result.texture_splits.sort();
  return result;
}

}  // namespace barkridge
