#pragma once
// The surface that Loop subdivision tends to: every vertex of a mesh has its place and its normal on it.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "mesh/mesh.h"
#include "subdivision/control_mesh.h"
#include "subdivision/loop.h"

namespace barkridge {

/// A mesh on the limit surface, with the texture coordinates that belong there.
struct LimitSurface {
  Mesh mesh;
  std::vector<glm::vec2> texture;  ///< with the triangles of texture as in `ControlMesh`; both empty without texture
  std::vector<std::array<std::uint32_t, 3>> texture_triangles;
};

/// Refines `levels` times, as `subdivide` does, and takes every vertex to its limit, with the surface's normal there
/// [HDD94]. Semi-sharp edges that are not used up by then count with what they will yet do. Where the surface has no
/// one normal: subdivision/ring.h, `limit_normal`. Internodes and ages become attributes of the mesh.
///
/// Throws as `subdivide`. Parallel; memory and time in proportion to the result.
LimitSurface limit_surface(const ControlMesh& mesh, int levels, const LoopOptions& options = {});

}  // namespace barkridge
