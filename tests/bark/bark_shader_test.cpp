#include "bark/bark_shader.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "blobtree/from_skeleton.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

constexpr double kTurn = 6.283185307179586;

std::shared_ptr<const SurfaceShader> shader_of(const Skeleton& skeleton, const BarkOptions& options) {
  const PlantTree plant = plant_from_skeleton(skeleton);
  return make_bark_shader(plant.tree, skeleton, plant.primitives, {}, options);
}

}  // namespace

TEST_CASE("plain bark has no shader") { CHECK(shader_of(chain(1, 3, 0), {}) == nullptr); }

TEST_CASE("a poplar's bark has no seam around the branch nor at joints") {
  BarkOptions options;
  options.kind = BarkKind::kPoplar;
  const auto shader = shader_of(chain(1.3, 8, 0.02), options);
  Color last(0);
  constexpr double kStep = 1e-4;
  for (double s = 0; s < 2 * kTurn; s += kStep) {
    // Once around, then up across the joints, in steps much finer than the pattern.
    const Vec3 normal = s < kTurn ? Vec3(std::sin(s), 0, std::cos(s)) : Vec3(0, 0, 1);
    const Vec3 p = Vec3(0, s < kTurn ? 3 : s - kTurn + 1, 0) + 0.93 * normal;
    const ShadedPoint shaded = shader->shade(p, normal, 1e-3);
    if (s > 0 && std::abs(s - kTurn) > 2 * kStep) CHECK(glm::distance(shaded.material.color, last) < 0.02);
    CHECK(glm::length(shaded.normal) == Approx(1));
    last = shaded.material.color;
  }
}

TEST_CASE("thick branches are furrowed and thin ones smooth and pale") {
  BarkOptions options;
  options.kind = BarkKind::kPoplar;
  options.scale = 0.05;
  options.furrowed_radius = 0.1;
  const auto shader_at = [&](double radius) {
    Skeleton skeleton;
    skeleton.internodes.push_back({Vec3(0), Vec3(0, 3, 0), radius, radius});
    const auto shader = shader_of(skeleton, options);
    double bumps = 0, brightness = 0;
    for (int i = 0; i < 2000; ++i) {
      const double turn = 0.7 * i, y = 0.5 + 2 * (i / 2000.0);
      const Vec3 normal(std::sin(turn), 0, std::cos(turn));
      const ShadedPoint shaded = shader->shade(radius * normal + Vec3(0, y, 0), normal, 1e-4);
      bumps += 1 - glm::dot(shaded.normal, normal);
      brightness += (shaded.material.color.x + shaded.material.color.y + shaded.material.color.z) / 3;
    }
    return std::pair(bumps / 2000, brightness / 2000);
  };
  const auto [old_bumps, old_brightness] = shader_at(0.4);
  const auto [young_bumps, young_brightness] = shader_at(0.02);
  CHECK(old_bumps > 10 * young_bumps);
  CHECK(young_brightness > 1.5 * old_brightness);
}

TEST_CASE("a ridge has its colour where branches touch, and none far away") {
  BarkOptions options;
  options.kind = BarkKind::kEven;
  options.ridge = 1;
  options.ridge_color = {1, 0, 0};
  const auto shader = shader_of(fork(2, 40), options);
  const Color crotch = shader->shade({0, 1.05, 0}, {0, 1, 0}, 1e-3).material.color;
  // The trunk has a share there too, and no ridge.
  CHECK(crotch.x > 0.75);
  CHECK(crotch.y < 0.1);
  CHECK(shader->shade({0, -5, 1}, {0, 0, 1}, 1e-3).material.color == Material{}.color);
}

TEST_CASE("a cut shows rings about the axis that was cut") {
  BlobTree tree;
  const NodeId trunk = tree.add(Cone{{0, 0, 0}, {0, 4, 0}, 1, 1});
  tree.add(Difference{}, {trunk, tree.add(Disc{{0, 4, 0}, {0, 1, 0}, 3, 1})});
  BarkOptions options;
  options.kind = BarkKind::kEven;
  options.ring_width = 0.1;
  const auto shader = make_bark_shader(tree, {}, {}, {}, options);
  // From the axis outward wood darkens towards each year's end and is pale again beyond it.
  int year_ends = 0;
  double last = 1;
  for (double x = 0.02; x < 0.9; x += 0.002) {
    const double brightness = shader->shade({x, 3, 0}, {0, 1, 0}, 1e-4).material.color.x;
    year_ends += brightness > last + 0.04;
    last = brightness;
  }
  CHECK(year_ends >= 6);
  CHECK(year_ends <= 30);
  CHECK(shader->shade({1, 1, 0}, {1, 0, 0}, 1e-4).material.color == Material{}.color);
}
