#pragma once
// Uniform Loop subdivision.

#include <cstddef>

#include "subdivision/control_mesh.h"

namespace barkridge {

struct LoopOptions {
  /// Whether vertices of a single triangle, the corners of a sheet, stay where they are. Otherwise a boundary is a
  /// cubic B-spline curve all around, but for its sharp vertices.
  bool keep_corners = false;
  /// Most triangles of a result; 0 means as many as 32-bit half-edges allow, 1.4e9.
  std::size_t max_triangles = 0;
};

/// Splits every triangle in four, `levels` times over, by Loop's scheme [Loop87]: interior vertices and edges by his
/// masks, boundaries and creases as cubic B-spline curves with corners and darts [HDD94], semi-sharp edges and vertices
/// by uniform decay [DKT98]. Positions agree with OpenSubdiv's Loop scheme under boundary interpolation `EDGE_ONLY`, or
/// `EDGE_AND_CORNER` with `keep_corners`, and uniform creasing.
///
/// Texture coordinates are refined by the same masks inside charts. The outline of a chart, along seams and boundaries,
/// keeps its shape in the texture exactly, by linear interpolation (face-varying option `LINEAR_BOUNDARIES`): pictures
/// are not pulled away from their borders, and both sides of a seam stay in step. Coordinates that different vertices
/// share in `texture`, or different fans of one vertex, become one for each.
///
/// A step's vertices are those before it, with their numbers, then one an edge; triangle `t` becomes `4 t` .. `4 t +
/// 3`, the last in the middle. New vertices get the mean age of their edge's ends, and the younger, higher internode of
/// both. Sharpnesses of the result are what is left of them; more than 32 is as good as infinite.
///
/// Throws as `check`; `InputError` for negative levels; `LimitError` before memory is taken. The result does not depend
/// on threads. Parallel; memory and time in proportion to the result.
ControlMesh subdivide(const ControlMesh& mesh, int levels, const LoopOptions& options = {});

}  // namespace barkridge
