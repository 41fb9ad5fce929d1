#include "bark/texture_mapping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace barkridge {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

double texture_repeats(const TextureMapping& mapping, const BranchFrame& frame) {
  const double mean = 0.5 * (frame.base_radius + frame.tip_radius);
  const double radius = mapping.followed_radius > 0 ? mapping.followed_radius : mean;
  return std::max(1.0, std::round(kTurn * radius / mapping.width));
}

glm::dvec2 texture_coordinates(const TextureMapping& mapping, const BranchFrame& frame, const BranchPoint& at) {
  const double repeats = texture_repeats(mapping, frame);
  const double u = repeats * at.around / kTurn;
  // Followed, the image is as wide as a part of the circumference, and as much lower as it is narrower.
  if (mapping.followed_radius > 0) return {u, repeats * at.turns * mapping.width / mapping.height};
  return {u, at.position.y / mapping.height};
}

}  // namespace barkridge
