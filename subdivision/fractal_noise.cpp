#include "subdivision/fractal_noise.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/random.h"
#include "subdivision/loop_level.h"

namespace barkridge {

namespace {

void check(const FractalNoise& noise) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError(fmt::format("{} of fractal noise, but it is {}", what, value));
  };
  require(noise.amplitude >= 0 && std::isfinite(noise.amplitude), "expected an amplitude >= 0", noise.amplitude);
  require(noise.lacunarity > 1 && std::isfinite(noise.lacunarity), "expected a lacunarity > 1", noise.lacunarity);
  require(noise.hurst >= 0 && noise.hurst <= 1, "expected a Hurst exponent from 0 to 1", noise.hurst);
  require(noise.bias > 0 && noise.bias <= 1, "expected a bias above 0 and up to 1", noise.bias);
}

// A normally distributed number with mean 0 and variance 1 that the keys decide [Box, Muller 1958].
double random_normal(std::uint64_t seed, int step, std::size_t vertex) {
  const double radius = std::sqrt(-2 * std::log(1 - random_unit(seed, step, vertex, 0)));
  return radius * std::cos(2 * std::numbers::pi * random_unit(seed, step, vertex, 1));
}

// The sum of the normals of a vertex's triangles, by area.
glm::dvec3 mean_normal(const Sheet<glm::vec3>& sheet, std::uint32_t v) {
  glm::dvec3 total(0), before(0);
  bool first = true;
  const glm::dvec3 center(sheet.values[v]);
  const bool closed = around(sheet.mesh, v, [&](std::uint32_t, std::uint32_t neighbour) {
    const glm::dvec3 side = glm::dvec3(sheet.values[neighbour]) - center;
    if (!first) total += glm::cross(before, side);
    before = side;
    first = false;
  });
  if (!closed) return total;
  return total + glm::cross(before, glm::dvec3(sheet.values[sheet.mesh.to(sheet.mesh.outgoing[v])]) - center);
}

void roughen(LoopLevel& level, int step, const FractalNoise& noise) {
  const double deviation = noise.amplitude * std::pow(noise.lacunarity, -step * noise.hurst);
  const double exponent = std::log(noise.bias) / std::log(0.5);
  const double oldest = level.ages.empty() ? 0.0 : *std::max_element(level.ages.begin(), level.ages.end());
  const auto feature_size = [&](std::size_t v) {
    return oldest > 0 ? std::pow(std::max(level.ages[v] / oldest, 0.0), exponent) : 1.0;
  };
  std::vector<glm::vec3> moved(level.surface.values.size());
  tbb::parallel_for(std::size_t{0}, moved.size(), [&](std::size_t v) {
    const glm::dvec3 normal = mean_normal(level.surface, static_cast<std::uint32_t>(v));
    const double length = glm::length(normal);
    const double distance = deviation * feature_size(v) * random_normal(noise.seed, step, v);
    moved[v] = level.surface.values[v];
    if (length > 0 && std::isfinite(length)) moved[v] = glm::vec3(glm::dvec3(moved[v]) + distance / length * normal);
  });
  level.surface.values = std::move(moved);
}

}  // namespace

ControlMesh subdivide_with_noise(const ControlMesh& mesh, int levels, const FractalNoise& noise,
                                 const LoopOptions& options) {
  check(noise);
  LoopLevel level = refined_level(mesh, levels, Refine::connectivity, options,
                                  [&](LoopLevel& fine, int step) { roughen(fine, step, noise); });
  return to_control_mesh(std::move(level));
}

}  // namespace barkridge
