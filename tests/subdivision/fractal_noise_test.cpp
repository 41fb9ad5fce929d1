// Fractal noise has the statistics that it says.

#include "subdivision/fractal_noise.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "subdivision/to_mesh.h"
#include "tests/subdivision/meshes.h"
#include "tests/support/mesh_checks.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// The mean and the standard deviation of heights.
std::pair<double, double> heights(const ControlMesh& mesh) {
  double sum = 0, squares = 0;
  for (const auto& p : mesh.positions) {
    sum += p.z;
    squares += static_cast<double>(p.z) * p.z;
  }
  const auto count = static_cast<double>(mesh.positions.size());
  return {sum / count, std::sqrt(squares / count - sum / count * (sum / count))};
}

}  // namespace

TEST_CASE("the first step moves vertices along normals by its standard deviation") {
  FractalNoise noise;
  noise.amplitude = 0.3;
  noise.hurst = 0.5;
  const auto [mean, deviation] = heights(subdivide_with_noise(grid(60, 60), 1, noise));
  CHECK(std::abs(mean) < 0.01);
  CHECK(deviation == Approx(0.3 / std::sqrt(2.0)).epsilon(0.03));  // 14 641 vertices
}

TEST_CASE("bias makes younger vertices move less") {
  ControlMesh mesh = grid(60, 60);
  mesh.ages.assign(mesh.positions.size(), 2);
  // An old vertex apart from the rest.
  mesh.positions.emplace_back(0, 0, 0);
  mesh.ages.push_back(8);
  FractalNoise noise;
  noise.amplitude = 0.3;
  noise.hurst = 0;
  noise.bias = 0.25;
  // t = 1/4, Bias(t) = t^2 = 1/16.
  CHECK(heights(subdivide_with_noise(mesh, 1, noise)).second == Approx(0.3 / 16).epsilon(0.03));
  noise.bias = 0.5;
  CHECK(heights(subdivide_with_noise(mesh, 1, noise)).second == Approx(0.3 / 4).epsilon(0.03));
  noise.bias = 1;
  CHECK(heights(subdivide_with_noise(mesh, 1, noise)).second == Approx(0.3).epsilon(0.03));
}

TEST_CASE("noise of no amplitude is none, and seeds make different noise") {
  FractalNoise noise;
  const ControlMesh smooth = subdivide(torus(), 3);
  CHECK(subdivide_with_noise(torus(), 3, noise).positions == smooth.positions);
  noise.amplitude = 0.02;
  const ControlMesh rough = subdivide_with_noise(torus(), 3, noise);
  CHECK(rough.triangles == smooth.triangles);
  CHECK(require_closed_manifold(to_mesh(rough)).genus == 1);
  noise.seed = 1;
  CHECK(subdivide_with_noise(torus(), 3, noise).positions != rough.positions);
}

TEST_CASE("noise out of range is an error") {
  const auto with = [](auto change) {
    FractalNoise noise;
    change(noise);
    return noise;
  };
  CHECK_THROWS_AS(subdivide_with_noise(octahedron(), 1, with([](auto& n) { n.amplitude = -1; })), InputError);
  CHECK_THROWS_AS(subdivide_with_noise(octahedron(), 1, with([](auto& n) { n.lacunarity = 1; })), InputError);
  CHECK_THROWS_AS(subdivide_with_noise(octahedron(), 1, with([](auto& n) { n.hurst = 1.5; })), InputError);
  CHECK_THROWS_AS(subdivide_with_noise(octahedron(), 1, with([](auto& n) { n.bias = 0; })), InputError);
}
