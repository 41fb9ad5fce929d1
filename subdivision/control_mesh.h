#pragma once
// The coarse mesh that Loop subdivision refines: the waist between dressing a skeleton and refining its surface.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lsystem/skeleton.h"

namespace barkridge {

/// The sharpness of an edge or vertex that subdivision never smooths.
inline constexpr float kInfinitelySharp = std::numeric_limits<float>::infinity();

/// A manifold triangle mesh, with or without boundary, and all that refinement carries along. Triangles are
/// counter-clockwise seen from outside; an edge that has one triangle is a boundary.
struct ControlMesh {
  struct SharpEdge {
    std::array<std::uint32_t, 2> vertices{};  ///< an edge of the mesh
    float sharpness = kInfinitelySharp;       ///< > 0: for as many steps the edge stays a crease, fractions blend
  };
  struct SharpVertex {
    std::uint32_t vertex = 0;
    float sharpness = kInfinitelySharp;  ///< > 0: for as many steps the vertex stays where it is
  };

  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Texture coordinates, and for each triangle those of its corners; both empty without texture. Corners of one vertex
  /// that differ make a seam.
  std::vector<glm::vec2> texture;
  std::vector<std::array<std::uint32_t, 3>> texture_triangles;
  std::vector<SharpEdge> sharp_edges;
  std::vector<SharpVertex> sharp_vertices;
  /// For each vertex the internode it dresses, and its age in derivation steps; both empty where nobody knows.
  std::vector<InternodeId> internodes;
  std::vector<float> ages;
};

/// Throws `InputError` that names the first guilty element: an index out of range, a triangle that repeats a vertex, an
/// edge of more than two triangles or of two that disagree in orientation, a vertex whose triangles are not one fan,
/// arrays of the wrong size, a number that is not finite, a sharp edge that no triangle has, a sharpness not above 0.
void check(const ControlMesh& mesh);

/// Throws as `check` does, and otherwise returns who is next to whom (subdivision/half_edges.h).
struct HalfEdges connect(const ControlMesh& mesh);

}  // namespace barkridge
