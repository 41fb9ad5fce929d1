#pragma once
// Connectivity, values at its vertices and sharpness: what one step of Loop subdivision takes and makes. A surface is
// one sheet of positions and, with texture, another of texture coordinates, cut open along the seams.

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "subdivision/half_edges.h"

namespace barkridge {

enum class Border {
  smooth,  ///< a boundary is a cubic B-spline curve
  linear,  ///< a boundary stays the polygon that it is
};

/// `Value` is `glm::vec3` or `glm::vec2`.
template <class Value>
struct Sheet {
  HalfEdges mesh;
  std::vector<Value> values;  ///< one a vertex
  /// Of the first edges and the first vertices, >= 0, infinite for ever; all others are smooth. (Refinement keeps what
  /// descends from coarse edges and vertices in front, so these lists grow with the length of edges, not with area.)
  std::vector<float> edge_sharpness, vertex_sharpness;
  Border border = Border::smooth;

  float sharpness_of_edge(std::uint32_t edge) const { return edge < edge_sharpness.size() ? edge_sharpness[edge] : 0; }
  float sharpness_of_vertex(std::uint32_t v) const { return v < vertex_sharpness.size() ? vertex_sharpness[v] : 0; }
};

/// One step of Loop subdivision: connectivity as of `refined(const HalfEdges&)`; values by the masks of [Loop87];
/// creases and corners, sharp for ever or for some steps, by those of [HDD94] and [DKT98] (subdivision/ring.h).
/// Vertices without triangles stay. Parallel, O(n).
template <class Value>
Sheet<Value> refined(const Sheet<Value>& sheet, Refine what);

/// A vertex at its limit, with the surface's unit normal there (subdivision/ring.h).
struct LimitPoint {
  glm::vec3 position{0};
  glm::vec3 normal{0, 1, 0};
};

/// The limit of a vertex; one without triangles stays where it is.
LimitPoint limit_point(const Sheet<glm::vec3>& surface, std::uint32_t vertex);

/// Texture coordinates at their limit; those on a border stay.
glm::vec2 limit_texture(const Sheet<glm::vec2>& charts, std::uint32_t vertex);

}  // namespace barkridge
