#include "subdivision/frames.h"

namespace barkridge {

Frame frame_towards(const Vec3& tangent, const Vec3& toward) {
  constexpr double kParallel = 1e-9;
  const Vec3 across = toward - glm::dot(toward, tangent) * tangent;
  const double length = glm::length(across);
  if (length > kParallel) return {tangent, across / length};
  Frame frame{tangent, {}};
  Vec3 binormal;
  complete_frame(tangent, frame.normal, binormal);
  return frame;
}

Frame transported(const Frame& frame, const Vec3& tangent) {
  constexpr double kOpposite = 1e-12;
  const double cosine = glm::dot(frame.tangent, tangent);
  Vec3 normal = frame.normal;
  if (1 + cosine > kOpposite) {
    normal -= glm::dot(tangent, normal) / (1 + cosine) * (frame.tangent + tangent);
  }
  // Rounding adds up along a branch of a million internodes.
  return frame_towards(tangent, normal);
}

}  // namespace barkridge
