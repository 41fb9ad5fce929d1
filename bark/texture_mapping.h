#pragma once
// Where an image of bark lies on a branch.

#include <glm/vec2.hpp>

#include "bark/branch_coordinates.h"

namespace barkridge {

struct TextureMapping {
  double width = 1, height = 1;  ///< of bark that the whole image covers, in scene units
  /// Whether the image shrinks with the branch instead: as often around thin branches as around one of this radius.
  /// 0: it keeps its size, and goes a whole number of times around.
  double followed_radius = 0;
};

/// How often the image goes around; the same on all of a primitive, so that it closes.
double texture_repeats(const TextureMapping& mapping, const BranchFrame& frame);

/// Coordinates in images, of which one has the width and height 1: u around, v along the branch. On an axis of equal
/// repeats they run on from parent to child.
glm::dvec2 texture_coordinates(const TextureMapping& mapping, const BranchFrame& frame, const BranchPoint& at);

}  // namespace barkridge
