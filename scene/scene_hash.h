#pragma once

#include <string>

#include "scene/pipeline.h"
#include "scene/scene.h"

namespace barkridge {

/// SHA-256, in 64 hexadecimal digits, of what a picture shows: the model as it was made (not the text that it was made
/// from: comments and names of files do not count) and the scene's junctions, bends, camera, light, ground and
/// material. How finely it is sampled (the keys `image` and `mesh`) does not count.
std::string scene_hash(const Scene& scene, const Model& model);

}  // namespace barkridge
