#include "bark/noise.h"

#include <array>
#include <cmath>

#include "base/random.h"

namespace barkridge {

namespace {

// The middles of a cube's edges, from its centre.
constexpr std::array<std::array<double, 3>, 12> kDirections{{{1, 1, 0},
                                                             {-1, 1, 0},
                                                             {1, -1, 0},
                                                             {-1, -1, 0},
                                                             {1, 0, 1},
                                                             {-1, 0, 1},
                                                             {1, 0, -1},
                                                             {-1, 0, -1},
                                                             {0, 1, 1},
                                                             {0, -1, 1},
                                                             {0, 1, -1},
                                                             {0, -1, -1}}};

Vec3 direction_at(const glm::i64vec3& cell, std::uint64_t seed) {
  const std::uint64_t hash = hash_keys(seed, cell.x, cell.y, cell.z) >> 32;
  const auto& d = kDirections[static_cast<std::size_t>(hash * kDirections.size() >> 32)];
  return {d[0], d[1], d[2]};
}

double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
double fade_slope(double t) { return 30 * t * t * (t - 1) * (t - 1); }

}  // namespace

Graded gradient_noise(const Vec3& p, std::uint64_t seed) {
  const Vec3 floor(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const glm::i64vec3 cell(floor);
  const Vec3 t = p - floor;
  const Vec3 f(fade(t.x), fade(t.y), fade(t.z)), slope(fade_slope(t.x), fade_slope(t.y), fade_slope(t.z));
  Graded sum;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::i64vec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
    const Vec3 gradient = direction_at(cell + at, seed);
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
