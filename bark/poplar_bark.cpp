#include "bark/poplar_bark.h"

#include <glm/common.hpp>

#include "base/noise.h"
#include "base/random.h"

namespace barkridge {

namespace {

// Which noise is for what.
enum Purpose : std::uint64_t { kWander, kWander2, kFurrows, kCracks, kBreaks, kGrain, kMottle, kAge, kLenticel };

// Colours apart, everything is in units of the bark's scale.
struct Furrowed {
  Graded height;     // 0 at the bottom of a furrow, about 1 on a ridge
  double light = 1;  // how much of the ridges' colour is left
};

// How much there is of a line around the places where a noise is zero: 1 in its middle, 0 from `width` on to both
// sides, across the branch. The noise over its slope, which counts as the same nearby, is about the distance. Where the
// noise's zero comes to lie along the surface, which would make a blot, the line ends.
Graded line_at_zero(const Vec3& p, const Vec3& scale, double width, std::uint64_t seed) {
  const Graded noise = gradient_noise(p, scale, seed);
  const double slope = std::max(std::hypot(noise.slope.x, noise.slope.z), 0.45 * scale.x);
  const double distance = std::hypot(p.x, p.z);
  const double around = distance > 0 ? std::abs(noise.slope.x * p.z - noise.slope.z * p.x) / distance : slope;
  const double crosses = smooth_step(0.35, 0.75, around / slope).value;
  return Graded(crosses) * (Graded(1) - smooth_step(0.12 * width, width, abs(noise) / slope));
}

// Furrows are where a noise, drawn out along the branch, is zero: lines that part and meet again around long ridges.
Furrowed furrowed(const Vec3& p, double age, double footprint) {
  // Ridges wander to and fro, and neighbours together.
  const Vec3 wander(0.45 * gradient_noise(p, {0.7, 0.3, 0.7}, kWander).value, 0,
                    0.45 * gradient_noise(p, {0.7, 0.3, 0.7}, kWander2).value);
  const Vec3 q = p + wander;
  const double coarse = seen_share(0.45, footprint), fine = seen_share(0.15, footprint);
  const Graded breaks = abs(gradient_noise(q, {0.9, 1.1, 0.9}, kBreaks));
  const Graded grain = layered_noise(p, {5, 1.3, 5}, 3, footprint, kGrain);

  const Graded ridge = Graded(1) - line_at_zero(q, {1.05, 0.13, 1.05}, 0.13 + 0.17 * age, kFurrows);
  const Graded crack = Graded(1) - line_at_zero(q, {2.3, 0.4, 2.3}, 0.09, kCracks);
  const Graded across = smooth_step(0, 0.05, breaks);
  constexpr double kMeanRidge = 0.66, kMeanCrack = 0.8, kMeanAcross = 0.9;
  const Graded top =
      Graded(0.72) + Graded(0.2) * mix(kMeanCrack, crack, fine) + Graded(0.08) * mix(kMeanAcross, across, fine);
  Furrowed result;
  result.height = mix(kMeanRidge, ridge * top, coarse) + Graded(0.1) * grain;
  const double hollow = glm::mix(kMeanRidge, ridge.value * (0.62 + 0.3 * crack.value + 0.08 * across.value), coarse);
  result.light = glm::clamp(0.16 + 0.84 * hollow + 0.45 * grain.value, 0.1, 1.3);
  return result;
}

// One lenticel: a small dark lens across the branch.
struct Lenticel {
  Graded bulge;  // 0 outside, 1 in the middle
  double dark = 0;
};

// Space is in cells, in some of which is one, near the middle: the nearest two each way hold all that can reach a
// point. `p` is in units of half the bark's scale.
Lenticel lenticels(const Vec3& p, double footprint) {
  const Vec3 cell_size(0.8, 0.45, 0.8);
  const double share = seen_share(0.06, footprint);
  Lenticel result;
  if (share == 0) return result;
  const Vec3 cells = p / cell_size - Vec3(0.5);
  const Vec3 floor(std::floor(cells.x), std::floor(cells.y), std::floor(cells.z));
  const double distance = std::hypot(p.x, p.z);
  const Vec3 tangent = distance > 0 ? Vec3(p.z, 0, -p.x) / distance : Vec3(1, 0, 0);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::i64vec3 cell = glm::i64vec3(floor) + glm::i64vec3(corner & 1, corner >> 1 & 1, corner >> 2);
    const auto random = [&](int use) { return random_unit(kLenticel, cell.x, cell.y, cell.z, use); };
    if (random(0) < 0.35) continue;
    const Vec3 center = (Vec3(cell) + Vec3(0.3) + 0.4 * Vec3(random(1), random(2), random(3))) * cell_size;
    const double half_width = 0.09 + 0.15 * random(4) * random(4), half_height = 0.03 + 0.015 * random(5);
    const Vec3 d = p - center;
    const double u = glm::dot(d, tangent) / half_width, v = d.y / half_height;
    const double radial = std::abs(distance - std::hypot(center.x, center.z));
    if (radial > 0.4) continue;
    const Graded reach(u * u + v * v, 2 * u / half_width * tangent + Vec3(0, 2 * v / half_height, 0));
    const Graded bulge = smooth_step(0, 1, Graded(1) - min(reach, 1.0));
    result.bulge = max(result.bulge, bulge);
  }
  result.bulge = Graded(share) * result.bulge;
  result.dark = result.bulge.value;
  return result;
}

}  // namespace

PatternPoint poplar_bark(const PoplarBark& bark, const BranchPoint& at, double footprint) {
  const Vec3 p = at.position / bark.scale;
  const double width = footprint / bark.scale;
  // Old and young bark meet in patches.
  const double age_of_radius = at.radius / bark.furrowed_radius + 0.35 * gradient_noise(p, {0.3, 0.1, 0.3}, kAge).value;
  const double age = smooth_step(0.55, 1.6, age_of_radius).value;

  const Graded mottle = layered_noise(p, {0.7, 0.5, 0.7}, 4, width, kMottle);
  PatternPoint result;
  if (age < 1) {
    const Lenticel spots = lenticels(2.0 * p, 2 * width);
    const Color smooth = bark.smooth_color * (1 + 0.35 * mottle.value);
    result.color = glm::mix(smooth, smooth * Color(0.22, 0.17, 0.13), 0.9 * spots.dark);
    result.height = Graded(0.03) * spots.bulge + Graded(0.02) * mottle;
  }
  if (age > 0) {
    const Furrowed old = furrowed(p, age, width);
    // The ridges weather to grey, the furrows stay brown.
    const Color tone = bark.furrowed_color * glm::mix(Color(0.75, 0.55, 0.4), Color(1), std::min(1.0, old.light));
    const Color color = tone * old.light * (1 + 0.25 * mottle.value);
    // Furrows open first, the ridges' tops stay smooth longest.
    const double share = smooth_step(0, 1, age * 1.6 - 0.6 * std::min(1.0, old.light)).value;
    result.color = glm::mix(result.color, color, share);
    result.height = mix(result.height, Graded(0.45 * (0.35 + 0.65 * age)) * (old.height - Graded(0.7)), share);
  }
  result.height = {result.height.value * bark.scale, result.height.slope};
  return result;
}

}  // namespace barkridge
