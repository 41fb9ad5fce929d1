#pragma once
// A plant's surface as numbers.

#include <memory>
#include <span>

#include "bark/texture_mapping.h"
#include "blobtree/tree.h"
#include "raytrace/surface_layers.h"

namespace barkridge {

/// Layers of the tree's surface: `deformation`, `ridge` and `cut` [blobtree/surface_probe.h]; and of the primitive with
/// the largest share, `primitive`, its node in the tree, `internode`, -1 for none, and texture coordinates `texture.u`,
/// `texture.v`. Numbers above 2^24 are rounded to what a float can hold. `primitives` are the nodes of the skeleton's
/// internodes. Keeps no reference.
std::shared_ptr<const SurfaceLayers> make_plant_layers(const BlobTree& tree, const Skeleton& skeleton,
                                                       std::span<const NodeId> primitives,
                                                       const TextureMapping& mapping);

}  // namespace barkridge
