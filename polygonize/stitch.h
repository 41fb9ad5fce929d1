#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "polygonize/surface_block.h"

namespace barkridge {

/// One mesh of all blocks: vertices and triangles block after block, in the order of the blocks' coordinates, whatever
/// order they come in. Throws `std::logic_error` if a block lacks a neighbour that its surface runs on into, which
/// means that the field broke its promises.
Mesh stitch(const std::vector<SurfaceBlock>& blocks);

}  // namespace barkridge
