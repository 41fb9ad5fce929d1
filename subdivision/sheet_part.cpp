#include "subdivision/sheet_part.h"

namespace barkridge {

namespace {

constexpr std::uint32_t kLeftOut = 0xffffffff;

// Numbers what was marked, in order: `number[i]` becomes the new number of `i`, and the result the old ones.
std::vector<std::uint32_t> renumber(std::vector<std::uint32_t>& number) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == kLeftOut) continue;
    number[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
  }
  return kept;
}

// The sharpness of what was kept of the front that has any.
std::vector<float> kept_sharpness(const std::vector<float>& sharpness, const std::vector<std::uint32_t>& kept) {
  std::vector<float> result;
  for (const std::uint32_t i : kept) {
    if (i >= sharpness.size()) break;
    result.push_back(sharpness[i]);
  }
  return result;
}

}  // namespace

template <class Value>
SheetPart<Value> part_of(const Sheet<Value>& whole, const std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> vertex(whole.mesh.outgoing.size(), kLeftOut), edge(whole.mesh.edges.size(), kLeftOut);
  std::vector<std::uint32_t> triangle(whole.mesh.triangles.size(), kLeftOut);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    triangle[triangles[i]] = i;
    for (const std::uint32_t v : whole.mesh.triangles[triangles[i]]) vertex[v] = 0;
    for (const std::uint32_t e : whole.mesh.triangle_edges[triangles[i]]) edge[e] = 0;
  }
  SheetPart<Value> part;
  part.vertices = renumber(vertex);
  part.edges = renumber(edge);
  part.sheet.border = whole.border;
  part.sheet.edge_sharpness = kept_sharpness(whole.edge_sharpness, part.edges);
  part.sheet.vertex_sharpness = kept_sharpness(whole.vertex_sharpness, part.vertices);

  const auto half_edge = [&](std::uint32_t h) {
    return h == kNoHalfEdge || triangle[h / 3] == kLeftOut ? kNoHalfEdge : 3 * triangle[h / 3] + h % 3;
  };
  HalfEdges& mesh = part.sheet.mesh;
  mesh.outgoing.assign(part.vertices.size(), kNoHalfEdge);
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = whole.mesh.triangles[t];
    const auto& [ab, bc, ca] = whole.mesh.triangle_edges[t];
    mesh.triangles.push_back({vertex[a], vertex[b], vertex[c]});
    mesh.triangle_edges.push_back({edge[ab], edge[bc], edge[ca]});
    for (std::uint32_t i = 0; i < 3; ++i) mesh.outgoing[mesh.triangles.back()[i]] = half_edge(3 * t + i);
  }
  for (const std::uint32_t e : part.edges) {
    const std::uint32_t first = half_edge(whole.mesh.edges[e][0]), second = half_edge(whole.mesh.edges[e][1]);
    mesh.edges.push_back({first == kNoHalfEdge ? second : first, first == kNoHalfEdge ? first : second});
  }
  for (const std::uint32_t v : part.vertices) {
    // On a boundary of the whole it matters where a walk starts.
    const std::uint32_t h = half_edge(whole.mesh.outgoing[v]);
    if (h != kNoHalfEdge) mesh.outgoing[vertex[v]] = h;
    part.sheet.values.push_back(whole.values[v]);
  }
  return part;
}

template SheetPart<glm::vec2> part_of(const Sheet<glm::vec2>&, const std::vector<std::uint32_t>&);
template SheetPart<glm::vec3> part_of(const Sheet<glm::vec3>&, const std::vector<std::uint32_t>&);

}  // namespace barkridge
