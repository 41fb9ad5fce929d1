#pragma once
// What a mesh is as a surface: closed or open, manifold or not, how many pieces and handles.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "mesh/mesh.h"

namespace barkridge {

/// The findings of `examine`. Vertices are told apart by index, not by position.
struct MeshReport {
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::size_t components = 0;  ///< pieces that share no vertex

  std::size_t invalid_triangles = 0;     ///< naming a vertex twice, or one that is not there; left out of all else
  std::size_t nonmanifold_edges = 0;     ///< with more than two triangles
  std::size_t misoriented_edges = 0;     ///< with two triangles that run along it in the same direction
  std::size_t boundary_edges = 0;        ///< with one triangle
  std::size_t nonmanifold_vertices = 0;  ///< whose triangles are not a single fan
  std::size_t degenerate_triangles = 0;  ///< of no area, or not finite
  std::size_t coincident_vertices = 0;   ///< at the place of another vertex of lower index
  std::size_t unused_vertices = 0;       ///< in no triangle

  std::int64_t euler_characteristic = 0;  ///< used vertices - edges + triangles
  /// Handles, summed over components; only of closed, oriented manifolds.
  std::optional<std::int64_t> genus;
  double area = 0;
  /// Enclosed volume, positive when triangles are counter-clockwise from outside; of meaning when closed.
  double volume = 0;
  /// The first fault found, with its place, in the order of the counts above; empty when all of them are zero.
  std::string first_fault;

  /// Whether the mesh is the whole boundary of a solid, consistently oriented.
  bool closed_manifold() const {
    return invalid_triangles + nonmanifold_edges + misoriented_edges + boundary_edges + nonmanifold_vertices == 0;
  }
};

/// Examines a mesh of any kind, also a broken one. O(n log n), about a microsecond a vertex.
MeshReport examine(const Mesh& mesh);

}  // namespace barkridge
