#pragma once
// The surface that Loop subdivision tends to: every vertex of a mesh has its place and its normal on it.

#include "mesh/mesh.h"
#include "subdivision/control_mesh.h"
#include "subdivision/loop.h"

namespace barkridge {

/// Refines `levels` times, as `subdivide` does, and takes every vertex to its limit, with the surface's normal there
/// [HDD94]. Semi-sharp edges that are not used up by then count with what they will yet do. Where the surface has no
/// one normal: subdivision/ring.h, `limit_normal`. Texture coordinates are taken to theirs, and
/// internodes and ages become attributes of the mesh.
///
/// Throws as `subdivide`. Parallel; memory and time in proportion to the result.
Mesh limit_surface(const ControlMesh& mesh, int levels, const LoopOptions& options = {});

}  // namespace barkridge
