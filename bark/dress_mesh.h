#pragma once
// A mesh with what its surface is, not only where.

#include <span>

#include "bark/texture_mapping.h"
#include "blobtree/tree.h"
#include "mesh/mesh.h"
#include "raytrace/surface_shader.h"

namespace barkridge {

struct DressOptions {
  TextureMapping texture;
  /// Tells the vertices' colours; without it they get none.
  const SurfaceShader* shader = nullptr;
  double footprint = 0;  ///< width of what a colour stands for
};

/// Gives a mesh of the tree's surface texture coordinates, and to its vertices the attributes `deformation` and `ridge`
/// [blobtree/surface_probe.h] and `internode`, -1 for none. A triangle lies in the coordinates of one primitive, of
/// that with the largest share at two of its corners or the first; seams are where these change, and where the image
/// closes around a branch. `primitives` are the nodes of the skeleton's internodes. The mesh has normals. On all
/// threads; a microsecond or two a vertex.
Mesh dressed(Mesh mesh, const BlobTree& tree, const Skeleton& skeleton, std::span<const NodeId> primitives,
             const DressOptions& options);

}  // namespace barkridge
