#pragma once
// Frames along a branch that turn no more than its axis does, so that cross-sections meet without twist.

#include "base/geometry.h"

namespace barkridge {

/// A cross-section's axes: two unit vectors at right angles. The third, `binormal`, completes them to a right-handed
/// frame (normal, binormal, tangent).
struct Frame {
  Vec3 tangent{0, 1, 0};  ///< along the branch, from its base to its tip
  Vec3 normal{1, 0, 0};

  Vec3 binormal() const { return glm::cross(tangent, normal); }
};

/// The frame along the unit vector `tangent` whose normal points as far towards `toward` as it can; some fixed one
/// where `toward` is parallel to the tangent or zero.
Frame frame_towards(const Vec3& tangent, const Vec3& toward);

/// Carries a frame to another tangent of length 1 by the smallest rotation between the two: parallel transport
/// [Bloo90]. A tangent that turns back is met by half a turn about the normal.
Frame transported(const Frame& frame, const Vec3& tangent);

}  // namespace barkridge
