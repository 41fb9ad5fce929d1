// Errors of meshes whose errors are known.

#include "study/surface_error.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace barkridge;

namespace {

// A tube of flat sides along y.
Mesh tube(std::uint32_t sides, double radius, std::uint32_t rows) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * M_PI * i / sides;
      mesh.positions.emplace_back(radius * std::cos(angle), 4.0 * j / rows, radius * std::sin(angle));
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = j * sides + i, b = j * sides + (i + 1) % sides;
      mesh.triangles.push_back({a, a + sides, b});
      mesh.triangles.push_back({b, a + sides, b + sides});
    }
  }
  return mesh;
}

Skeleton stem() {
  Skeleton skeleton;
  Internode internode;
  internode.tip = {0, 4, 0};
  internode.base_radius = internode.tip_radius = 0.5;
  skeleton.internodes.push_back(internode);
  return skeleton;
}

}  // namespace

TEST_CASE("windows lie on the plant's surface, and are functions of their arguments") {
  const std::vector<Box> windows = error_windows(stem(), 0.2, 30);
  REQUIRE(windows.size() == 30);
  for (const Box& window : windows) {
    const Vec3 c = window.center();
    CHECK(std::hypot(c.x, c.z) == Approx(0.5));
    CHECK(c.y >= 0);
    CHECK(c.y <= 4);
    CHECK(window.hi.x - window.lo.x == Approx(0.2));
  }
  CHECK(error_windows(stem(), 0.2, 30).back().lo == windows.back().lo);
  CHECK(error_windows({}, 0.2, 30).empty());
}

TEST_CASE("the error of flat sides is the sagitta of their chords") {
  const std::vector<Mesh> meshes{tube(8, 0.5, 40), tube(16, 0.5, 40), Mesh{}};
  const Mesh fine = tube(2000, 0.5, 400);
  const auto errors = surface_errors(meshes, error_windows(stem(), 0.4, 40), 0.2, [&](const Box&) { return fine; });
  REQUIRE(errors.size() == 3);
  CHECK(errors[0].largest == Approx(0.5 * (1 - std::cos(M_PI / 8))).epsilon(0.02));
  CHECK(errors[1].largest == Approx(0.5 * (1 - std::cos(M_PI / 16))).epsilon(0.02));
  CHECK(errors[0].root_mean_square() > 3 * errors[1].root_mean_square());
  CHECK(errors[2].count == 0);
}

TEST_CASE("what a mesh lacks counts as its error") {
  Mesh half = tube(64, 0.5, 40);
  half.triangles.resize(half.triangles.size() / 2);
  const auto errors = surface_errors(std::vector<Mesh>{half}, error_windows(stem(), 0.4, 40), 0.2,
                                     [](const Box&) { return tube(500, 0.5, 100); });
  CHECK(errors[0].largest > 1.5);
}
