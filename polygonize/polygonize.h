#pragma once

#include <cstddef>

#include "base/progress.h"
#include "blobtree/field.h"
#include "mesh/mesh.h"

namespace barkridge {

struct PolygonizeOptions {
  /// Edge length of the sampling cells, in scene units; > 0 and finite.
  double cell_size = 0;
  /// Most triangles; 0 means as many as 31-bit vertex indices allow.
  std::size_t max_triangles = 0;
  /// Whether creases are closed at the bottom where they are narrower than a cell, and pieces of the surface too small
  /// for the lattice are left out (polygonize/unresolved_pieces.h). Without this, signs at lattice points alone decide,
  /// and creases show spurious hollows, specks and tunnels.
  bool close_creases = true;
  Progress progress;
};

/// The surface of the field's solid as a closed, oriented 2-manifold that does not intersect itself: marching cubes
/// over those blocks of the lattice (multiples of `cell_size` from the origin) that the field's cells touch and its
/// bounds cannot rule out, so nothing is missed that the lattice can see and empty space is never sampled.
///
/// Each lattice edge with one end inside has one vertex, at a root of the field (not of its linear interpolation) to
/// 1e-5 of a cell, but at least 1e-3 of a cell away from the edge's ends (more where floats are too coarse for that),
/// so that no two vertices coincide and every triangle has an area. Normals are the field's own, `-grad F / |grad F|`;
/// where the gradient vanishes, the mean of the triangles'. The result depends on field and options only, to the bit,
/// not on threads.
///
/// Throws `InputError` for a cell size that is not positive or so small (about 1e-6 of the largest coordinate) that
/// floats cannot tell vertices apart, `LimitError` as soon as the triangles found exceed the limit, `Cancelled`;
/// `std::logic_error` where the field's bounds or restrictions contradict its values.
/// Memory: in proportion to the output. Cost: about 729 evaluations of the restricted field for every block of 8^3
/// cells near the surface and 4 or 5 for every vertex.
Mesh polygonize(const Field& field, const PolygonizeOptions& options);

}  // namespace barkridge
