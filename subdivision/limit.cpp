#include "subdivision/limit.h"

#include <tbb/parallel_for.h>

#include "base/large_room.h"
#include "subdivision/loop_level.h"
#include "subdivision/to_mesh.h"

namespace barkridge {

Mesh limit_surface(const ControlMesh& mesh, int levels, const LoopOptions& options) {
  LoopLevel level = refined_level(mesh, levels, Refine::connectivity, options);
  const std::size_t vertex_count = level.surface.values.size();
  Mesh limit;
  resize_large(limit.positions, vertex_count);
  resize_large(limit.normals, vertex_count);
  tbb::parallel_for(std::size_t{0}, vertex_count, [&](std::size_t i) {
    const LimitPoint point = limit_point(level.surface, static_cast<std::uint32_t>(i));
    limit.positions[i] = point.position;
    limit.normals[i] = point.normal;
  });
  resize_large(limit.texture, level.charts.values.size());
  tbb::parallel_for(std::size_t{0}, limit.texture.size(), [&](std::size_t i) {
    limit.texture[i] = limit_texture(level.charts, static_cast<std::uint32_t>(i));
  });
  limit.triangles = std::move(level.surface.mesh.triangles);
  keep_attributes(limit, std::move(level.internodes), std::move(level.ages));
  limit.texture_triangles = std::move(level.charts.mesh.triangles);
  return limit;
}

}  // namespace barkridge
