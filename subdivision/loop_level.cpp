#include "subdivision/loop_level.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/large_room.h"

namespace barkridge {

namespace {

using Triangle = HalfEdges::Triangle;

// Half-edges, and so triangles times 3, are counted in 32 bits.
constexpr std::size_t kMostTriangles = kNoHalfEdge / 3;

std::uint32_t find_edge(const HalfEdges& mesh, std::uint32_t a, std::uint32_t b) {
  std::uint32_t found = kNoHalfEdge;
  around(mesh, a, [&](std::uint32_t h, std::uint32_t neighbour) {
    if (neighbour == b) found = mesh.edge(h);
  });
  return found;
}

// A step halves edges: after so many no surface is left to tell sharp for long from sharp for ever.
constexpr float kForEver = 32;

float lasting(float sharpness) { return sharpness > kForEver ? kInfinitelySharp : sharpness; }

// Sharpness of edges and vertices that are named twice is the greater one.
void set_sharpness(const ControlMesh& mesh, const LoopOptions& options, Sheet<glm::vec3>& surface) {
  if (!mesh.sharp_edges.empty()) surface.edge_sharpness.assign(surface.mesh.edges.size(), 0);
  for (const ControlMesh::SharpEdge& sharp : mesh.sharp_edges) {
    float& sharpness = surface.edge_sharpness[find_edge(surface.mesh, sharp.vertices[0], sharp.vertices[1])];
    sharpness = std::max(sharpness, lasting(sharp.sharpness));
  }
  if (!mesh.sharp_vertices.empty() || options.keep_corners) surface.vertex_sharpness.assign(mesh.positions.size(), 0);
  for (const ControlMesh::SharpVertex& sharp : mesh.sharp_vertices) {
    surface.vertex_sharpness[sharp.vertex] = std::max(surface.vertex_sharpness[sharp.vertex], lasting(sharp.sharpness));
  }
  if (!options.keep_corners) return;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    int edges = 0;
    const bool inside = around(surface.mesh, v, [&](std::uint32_t, std::uint32_t) { ++edges; });
    if (!inside && edges == 2) surface.vertex_sharpness[v] = kInfinitelySharp;
  }
}

// Whether texture is torn along half-edge `h`: at its boundary, or where the triangles on both sides disagree on the
// texture coordinates of either end.
bool is_seam(const HalfEdges& mesh, const std::vector<Triangle>& texture, std::uint32_t h) {
  const std::uint32_t twin = mesh.twin(h);
  if (twin == kNoHalfEdge) return true;
  const auto at = [&](std::uint32_t corner) { return texture[corner / 3][corner % 3]; };
  return at(h) != at(HalfEdges::next(twin)) || at(HalfEdges::next(h)) != at(twin);
}

// The half-edges out of `v` that have a triangle, in the order of `around`, each with whether a fan starts with it. A
// fan without a seam starts anywhere.
void fans(const HalfEdges& mesh, const std::vector<Triangle>& texture, std::uint32_t v,
          std::vector<std::pair<std::uint32_t, bool>>& result) {
  result.clear();
  bool any = false;
  around(mesh, v, [&](std::uint32_t h, std::uint32_t) {
    if (mesh.from(h) != v) return;
    const bool starts = is_seam(mesh, texture, h);
    any = any || starts;
    result.emplace_back(h, starts);
  });
  if (!any && !result.empty()) result.front().second = true;
}

// Cuts the texture open along seams: every fan of every vertex gets a vertex of the sheet of its own.
Sheet<glm::vec2> cut_charts(const ControlMesh& mesh, const Sheet<glm::vec3>& surface) {
  Sheet<glm::vec2> charts;
  charts.border = Border::linear;
  if (mesh.texture_triangles.empty()) return charts;

  std::vector<Triangle> triangles(mesh.triangles.size());
  std::vector<std::uint32_t> vertex_of;
  std::vector<std::pair<std::uint32_t, bool>> corners;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    fans(surface.mesh, mesh.texture_triangles, v, corners);
    const auto start = std::find_if(corners.begin(), corners.end(), [](const auto& c) { return c.second; });
    std::rotate(corners.begin(), start, corners.end());
    for (const auto& [h, starts] : corners) {
      if (starts) {
        charts.values.push_back(mesh.texture[mesh.texture_triangles[h / 3][h % 3]]);
        vertex_of.push_back(v);
      }
      triangles[h / 3][h % 3] = static_cast<std::uint32_t>(charts.values.size() - 1);
    }
  }
  charts.mesh = half_edges(std::move(triangles), charts.values.size());
  if (!surface.edge_sharpness.empty()) {
    charts.edge_sharpness.reserve(charts.mesh.edges.size());
    for (const auto& [h, twin] : charts.mesh.edges) {
      charts.edge_sharpness.push_back(surface.sharpness_of_edge(surface.mesh.edge(h)));
    }
  }
  if (!surface.vertex_sharpness.empty()) {
    charts.vertex_sharpness.reserve(vertex_of.size());
    for (const std::uint32_t v : vertex_of) charts.vertex_sharpness.push_back(surface.vertex_sharpness[v]);
  }
  return charts;
}

// Appends what `middle` makes of the values at both ends of every edge.
template <class Value, class Middle>
std::vector<Value> with_edges(const HalfEdges& mesh, const std::vector<Value>& values, const Middle& middle) {
  std::vector<Value> result;
  if (values.empty()) return result;
  resize_large(result, values.size() + mesh.edges.size());
  std::copy(values.begin(), values.end(), result.begin());
  tbb::parallel_for(std::size_t{0}, mesh.edges.size(), [&](std::size_t e) {
    const std::uint32_t h = mesh.edges[e][0];
    result[values.size() + e] = middle(values[mesh.from(h)], values[mesh.to(h)]);
  });
  return result;
}

}  // namespace

LoopLevel coarse_level(const ControlMesh& mesh, const LoopOptions& options) {
  LoopLevel level;
  level.surface.mesh = connect(mesh);
  level.surface.values = mesh.positions;
  set_sharpness(mesh, options, level.surface);
  level.charts = cut_charts(mesh, level.surface);
  level.internodes = mesh.internodes;
  level.ages = mesh.ages;
  return level;
}

LoopLevel refined(const LoopLevel& level, Refine what) {
  LoopLevel fine;
  fine.surface = refined(level.surface, what);
  fine.charts = refined(level.charts, what);
  const HalfEdges& mesh = level.surface.mesh;
  fine.internodes = with_edges(mesh, level.internodes, [](InternodeId a, InternodeId b) { return std::max(a, b); });
  fine.ages = with_edges(mesh, level.ages, [](float a, float b) { return 0.5F * a + 0.5F * b; });
  return fine;
}

void check_triangle_count(std::size_t coarse_triangles, int levels, const LoopOptions& options) {
  if (levels < 0) throw InputError(fmt::format("expected a number of levels >= 0, but it is {}", levels));
  const std::size_t most =
      options.max_triangles == 0 ? kMostTriangles : std::min(options.max_triangles, kMostTriangles);
  std::size_t triangles = coarse_triangles;
  for (int level = 0; triangles > 0; ++level, triangles *= 4) {
    if (triangles > most) {
      throw LimitError(
          fmt::format("level {} of the subdivision of {} triangles has {}, more than the limit of {}: "
                      "ask for fewer levels, or raise the limit on triangles",
                      level, coarse_triangles, triangles, most));
    }
    if (level == levels) return;
  }
}

LoopLevel refined_level(const ControlMesh& mesh, int levels, Refine what, const LoopOptions& options,
                        const AfterStep& after_step) {
  check_triangle_count(mesh.triangles.size(), levels, options);
  LoopLevel level = coarse_level(mesh, options);
  if (mesh.triangles.empty()) return level;
  for (int step = 1; step <= levels; ++step) {
    level = refined(level, step < levels ? Refine::connectivity : what);
    if (after_step) after_step(level, step);
  }
  return level;
}

ControlMesh to_control_mesh(LoopLevel level) {
  ControlMesh mesh;
  const Sheet<glm::vec3>& surface = level.surface;
  const auto sharp_count = static_cast<std::uint32_t>(surface.edge_sharpness.size());
  for (std::uint32_t e = 0; e < sharp_count; ++e) {
    if (!(surface.edge_sharpness[e] > 0)) continue;
    const std::uint32_t h = surface.mesh.edges[e][0];
    mesh.sharp_edges.push_back({{surface.mesh.from(h), surface.mesh.to(h)}, surface.edge_sharpness[e]});
  }
  for (std::uint32_t v = 0; v < surface.vertex_sharpness.size(); ++v) {
    if (surface.vertex_sharpness[v] > 0) mesh.sharp_vertices.push_back({v, surface.vertex_sharpness[v]});
  }
  mesh.positions = std::move(level.surface.values);
  mesh.triangles = std::move(level.surface.mesh.triangles);
  mesh.texture = std::move(level.charts.values);
  mesh.texture_triangles = std::move(level.charts.mesh.triangles);
  mesh.internodes = std::move(level.internodes);
  mesh.ages = std::move(level.ages);
  return mesh;
}

}  // namespace barkridge
