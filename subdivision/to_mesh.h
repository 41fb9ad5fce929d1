#pragma once
// A control mesh as it is, for other rooms.

#include "mesh/mesh.h"
#include "subdivision/control_mesh.h"

namespace barkridge {

/// Gives a mesh the attributes `internode` and `age` by vertex, of those that are not empty.
void keep_attributes(Mesh& mesh, std::vector<InternodeId> internodes, std::vector<float> ages);

/// The positions, triangles, texture and attributes of `mesh` as they are, each vertex with the mean of its triangles'
/// normals, weighted by their areas; (0, 1, 0) where that vanishes. Takes what it can from its argument. O(n).
Mesh to_mesh(ControlMesh mesh);

}  // namespace barkridge
