#include "raytrace/light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace barkridge {

Color sky_radiance(const Sky& sky, const Vec3& direction) {
  const double below_zenith = 1 - std::clamp(direction.y, 0.0, 1.0);
  return sky.intensity * glm::mix(sky.zenith, sky.horizon, below_zenith * below_zenith * below_zenith);
}

Color sky_average(const Sky& sky) {
  // The integral over y in [0, 1] of 2 y (1 - y)^3 is 1 / 10.
  return sky.intensity * glm::mix(sky.zenith, sky.horizon, 0.1);
}

SunDisc::SunDisc(const Sun& sun)
    : center_(glm::normalize(sun.direction)), irradiance_(std::numbers::pi * sun.intensity * sun.color) {
  complete_frame(center_, across_, along_);
  // 1 - cos(a/2), without cancellation.
  const double sine = std::sin(0.25 * sun.angle_degrees * std::numbers::pi / 180);
  one_minus_cosine_ = 2 * sine * sine;
}

Vec3 SunDisc::direction(const glm::dvec2& u) const {
  const double drop = one_minus_cosine_ * u.x;
  const double sine = std::sqrt(drop * (2 - drop)), turn = 2 * std::numbers::pi * u.y;
  return glm::normalize((1 - drop) * center_ + sine * (std::cos(turn) * across_ + std::sin(turn) * along_));
}

}  // namespace barkridge
