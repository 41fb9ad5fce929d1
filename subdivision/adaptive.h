#pragma once
// Loop subdivision that is as fine as the surface asks for.

#include "subdivision/control_mesh.h"
#include "subdivision/limit.h"
#include "subdivision/loop.h"

namespace barkridge {

struct AdaptiveOptions {
  /// The most that the normals of two neighbouring triangles may differ, and the most that a boundary or sharp crease
  /// may turn at a vertex; > 0.
  double max_angle_degrees = 15;
  /// Triangles of no more area are not split, in square scene units; >= 0.
  double min_area = 0;
  int max_level = 6;  ///< triangles of this level are not split; 0 to 16
  LoopOptions loop;
};

/// Splits triangles, in four as `subdivide` does, until the result is within the tolerance: no two triangles meet at a
/// greater angle, other than along sharp creases, and no boundary or crease turns by more, other than at corners, but
/// where all that could be split further has reached `max_level` or `min_area`. Every vertex has its place and normal
/// on the limit surface, whatever the level of its triangles, so there are no steps between fine and coarse.
///
/// Without cracks: where a triangle's neighbours are finer, it is divided to meet all vertices along its sides. A
/// closed mesh stays closed, and charts of texture meet as they did. Internodes and ages go to new vertices as by
/// `subdivide`, and become attributes of the mesh. The result is the same for any number of threads.
///
/// Throws as `subdivide`, and `InputError` for tolerances out of range. A round splits all triangles that violate the
/// tolerance; there are a few more than levels, each in proportion to its result.
Mesh subdivide_adaptively(const ControlMesh& mesh, const AdaptiveOptions& options = {});

}  // namespace barkridge
