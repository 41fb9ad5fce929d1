#include "base/noise.h"

#include <cmath>

namespace barkridge {

namespace {

Vec3 direction_at(const glm::i64vec3& corner, std::uint32_t seed) {
  const std::uint32_t hash = lattice_hash(static_cast<std::uint32_t>(corner.x), static_cast<std::uint32_t>(corner.y),
                                          static_cast<std::uint32_t>(corner.z), seed);
  const double first = hash >> 31 ? -1 : 1, second = hash >> 30 & 1 ? -1 : 1;
  const std::uint32_t across = hash & 0xffff;
  if (across < kAcrossZ) return {first, second, 0};
  return across < kAcrossY ? Vec3(first, 0, second) : Vec3(0, first, second);
}

double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
double fade_slope(double t) { return 30 * t * t * (t - 1) * (t - 1); }

}  // namespace

Graded gradient_noise(const Vec3& p, std::uint64_t seed) {
  const std::uint32_t lattice = lattice_seed(seed);
  const Vec3 floor(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const glm::i64vec3 cell(floor);
  const Vec3 t = p - floor;
  const Vec3 f(fade(t.x), fade(t.y), fade(t.z)), slope(fade_slope(t.x), fade_slope(t.y), fade_slope(t.z));
  Graded sum;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::i64vec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
    const Vec3 gradient = direction_at(cell + at, lattice);
    const double ramp = glm::dot(gradient, t - Vec3(at));
    Vec3 weight, weight_slope;
    for (int axis = 0; axis < 3; ++axis) {
      weight[axis] = at[axis] ? f[axis] : 1 - f[axis];
      weight_slope[axis] = at[axis] ? slope[axis] : -slope[axis];
    }
    const double all = weight.x * weight.y * weight.z;
    sum.value += all * ramp;
    sum.slope +=
        all * gradient + ramp * Vec3(weight_slope.x * weight.y * weight.z, weight.x * weight_slope.y * weight.z,
                                     weight.x * weight.y * weight_slope.z);
  }
  return sum;
}

Graded gradient_noise(const Vec3& p, const Vec3& scale, std::uint64_t seed) {
  Graded noise = gradient_noise(p * scale, seed);
  noise.slope *= scale;
  return noise;
}

Graded layered_noise(const Vec3& p, const Vec3& scale, int octaves, double footprint, std::uint64_t seed) {
  Graded sum;
  double height = 1;
  Vec3 frequency = scale;
  for (int octave = 0; octave < octaves; ++octave, height /= 2, frequency *= 2.0) {
    const double finest = 1 / std::max({frequency.x, frequency.y, frequency.z});
    const double share = seen_share(finest, footprint);
    if (share == 0) break;
    sum = sum + Graded(height * share) * gradient_noise(p, frequency, hash_keys(seed, octave));
  }
  return sum;
}

double seen_share(double width, double footprint) { return 1 - smooth_step(0.5, 1.5, footprint / width).value; }

}  // namespace barkridge
