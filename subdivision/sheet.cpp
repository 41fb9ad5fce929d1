#include "subdivision/sheet.h"

#include <tbb/parallel_for.h>

#include <array>
#include <limits>

#include "base/large_room.h"
#include "subdivision/ring.h"

namespace barkridge {

namespace {

template <class Value>
using Double = glm::vec<Value::length(), double>;

template <class Value>
void gather(const Sheet<Value>& sheet, std::uint32_t v, VertexRing<Double<Value>>& ring) {
  ring.clear();
  ring.center = Double<Value>(sheet.values[v]);
  ring.center_sharpness = sheet.sharpness_of_vertex(v);
  ring.closed = around(sheet.mesh, v, [&](std::uint32_t h, std::uint32_t neighbour) {
    const std::uint32_t edge = sheet.mesh.edge(h);
    ring.neighbours.push_back(Double<Value>(sheet.values[neighbour]));
    ring.sharpness.push_back(sheet.mesh.is_boundary(edge) ? std::numeric_limits<double>::infinity()
                                                          : sheet.sharpness_of_edge(edge));
  });
}

template <class Value>
VertexRing<Double<Value>>& scratch_ring() {
  thread_local VertexRing<Double<Value>> ring;
  return ring;
}

// `neighbour_weight` of the valences that occur often.
float common_neighbour_weight(std::size_t valence) {
  static const std::array<float, 16> weights = [] {
    std::array<float, 16> result{};
    for (std::size_t n = 2; n < result.size(); ++n) result[n] = static_cast<float>(neighbour_weight(n));
    return result;
  }();
  return valence < weights.size() ? weights[valence] : static_cast<float>(neighbour_weight(valence));
}

template <class Value>
Value vertex_point(const Sheet<Value>& sheet, std::uint32_t v) {
  // Nearly all vertices are smooth, and need but the sum of their neighbours.
  Value sum(0);
  std::size_t valence = 0;
  bool smooth = sheet.sharpness_of_vertex(v) <= 0;
  const bool closed = around(sheet.mesh, v, [&](std::uint32_t h, std::uint32_t neighbour) {
    sum += sheet.values[neighbour];
    ++valence;
    smooth = smooth && sheet.sharpness_of_edge(sheet.mesh.edge(h)) <= 0;
  });
  if (valence == 0 || (!closed && sheet.border == Border::linear)) return sheet.values[v];
  if (closed && smooth) {
    const float weight = common_neighbour_weight(valence);
    return (1 - static_cast<float>(valence) * weight) * sheet.values[v] + weight * sum;
  }
  VertexRing<Double<Value>>& ring = scratch_ring<Value>();
  gather(sheet, v, ring);
  return Value(refined_center(ring));
}

template <class Value>
Value edge_point(const Sheet<Value>& sheet, std::uint32_t edge) {
  const auto& [h, twin] = sheet.mesh.edges[edge];
  const std::uint32_t a = sheet.mesh.from(h), b = sheet.mesh.to(h);
  const Value ends = sheet.values[a] + sheet.values[b];
  const float sharpness = sheet.sharpness_of_edge(edge);
  if (twin == kNoHalfEdge || sharpness >= 1) return 0.5F * ends;
  const std::uint32_t c = sheet.mesh.from(HalfEdges::previous(h)), d = sheet.mesh.from(HalfEdges::previous(twin));
  const Value smooth = 0.375F * ends + 0.125F * (sheet.values[c] + sheet.values[d]);
  return sharpness > 0 ? sharpness * (0.5F * ends) + (1 - sharpness) * smooth : smooth;
}

float decayed(float sharpness) { return sharpness > 1 ? sharpness - 1 : 0; }

}  // namespace

template <class Value>
Sheet<Value> refined(const Sheet<Value>& sheet, Refine what) {
  Sheet<Value> fine;
  fine.border = sheet.border;
  fine.mesh = refined(sheet.mesh, what);
  const std::size_t vertex_count = sheet.values.size(), edge_count = sheet.mesh.edges.size();
  resize_large(fine.values, vertex_count + edge_count);
  tbb::parallel_for(std::size_t{0}, vertex_count,
                    [&](std::size_t v) { fine.values[v] = vertex_point(sheet, static_cast<std::uint32_t>(v)); });
  tbb::parallel_for(std::size_t{0}, edge_count, [&](std::size_t e) {
    fine.values[vertex_count + e] = edge_point(sheet, static_cast<std::uint32_t>(e));
  });
  fine.edge_sharpness.reserve(2 * sheet.edge_sharpness.size());
  for (const float sharpness : sheet.edge_sharpness) {
    fine.edge_sharpness.insert(fine.edge_sharpness.end(), 2, decayed(sharpness));
  }
  if (what == Refine::triangles) {
    // Which edges are sharp is still of interest.
    for (std::size_t e = 0; e < sheet.edge_sharpness.size(); ++e) {
      for (const auto& half : edge_halves(sheet.mesh, e)) fine.mesh.edges.push_back(half);
    }
  }
  fine.vertex_sharpness.reserve(sheet.vertex_sharpness.size());
  for (const float sharpness : sheet.vertex_sharpness) fine.vertex_sharpness.push_back(decayed(sharpness));
  return fine;
}

LimitPoint limit_point(const Sheet<glm::vec3>& surface, std::uint32_t vertex) {
  VertexRing<glm::dvec3>& ring = scratch_ring<glm::vec3>();
  gather(surface, vertex, ring);
  LimitPoint point;
  point.position = surface.values[vertex];
  if (ring.neighbours.empty()) return point;
  return {glm::vec3(limit_position(ring)), glm::vec3(limit_normal(ring))};
}

glm::vec2 limit_texture(const Sheet<glm::vec2>& charts, std::uint32_t vertex) {
  VertexRing<glm::dvec2>& ring = scratch_ring<glm::vec2>();
  gather(charts, vertex, ring);
  return ring.closed ? glm::vec2(limit_position(ring)) : charts.values[vertex];
}

template Sheet<glm::vec2> refined(const Sheet<glm::vec2>&, Refine);
template Sheet<glm::vec3> refined(const Sheet<glm::vec3>&, Refine);

}  // namespace barkridge
