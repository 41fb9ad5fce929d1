#include "bark/wood.h"

#include <cmath>
#include <glm/common.hpp>

#include "base/noise.h"

namespace barkridge {

namespace {

enum Purpose : std::uint64_t { kLobes = 100, kYears, kRays, kFibres };

// Beyond this share of the radius there is bark.
constexpr double kBarkFrom = 0.93;

}  // namespace

PatternPoint wood_section(const Wood& wood, const BranchPoint& at, double footprint) {
  const Vec3& p = at.position;
  const double distance = std::hypot(p.x, p.z), share = at.radius > 0 ? distance / at.radius : 0;
  // Rings are not quite round, alike over some length, and years not alike.
  const double lobe = 0.06 * at.radius;
  const double wobble = gradient_noise(p / at.radius, {1.3, 0.4, 1.3}, kLobes).value;
  const double years = (distance + lobe * wobble) / wood.ring_width;
  const double uneven = years + 0.5 * gradient_noise({years, 0, 0}, {0.6, 1, 1}, kYears).value;
  // Early wood is pale and darkens towards the end of the year, where it stops at once.
  const double season = uneven - std::floor(uneven);
  const double seen = seen_share(0.5 * wood.ring_width, footprint);
  const double late = glm::mix(0.27, season * season * season * glm::smoothstep(0.0, 0.06, 1 - season), seen);

  const double angle_noise = gradient_noise(p / at.radius, {9, 1, 9}, kRays).value;
  const double fibres =
      layered_noise(p / wood.ring_width, {1.1, 0.15, 1.1}, 3, footprint / wood.ring_width, kFibres).value;
  Color color = wood.color * (1 - 0.5 * late) * (1 + 0.08 * angle_noise + 0.12 * fibres);
  // The heart is darker, and so is the section of the bark.
  color *= glm::mix(Color(0.72, 0.62, 0.55), Color(1), glm::smoothstep(0.25, 0.45, share + 0.1 * wobble));
  color = glm::mix(color, Color(0.09, 0.06, 0.04) * (1 + fibres), glm::smoothstep(kBarkFrom - 0.015, kBarkFrom, share));
  PatternPoint result;
  result.color = color;
  return result;
}

}  // namespace barkridge
