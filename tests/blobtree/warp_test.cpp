#include "blobtree/warp.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

std::vector<Warp> some_warps(RandomSource& random) {
  const Vec3 a = random.in_box({Vec3(-1), Vec3(1)}), d = random.direction();
  const Mat3 linear = Mat3(1) + 0.4 * Mat3(random.direction(), random.direction(), random.direction());
  return {Warp(Bend{a, a + 3.0 * d, glm::cross(d, random.direction()), random.uniform(5, 60)}, Box{Vec3(-1), Vec3(1)}),
          Warp(Twist{a, d, random.uniform(-90, 90)}), Warp(Taper{a, a + d, random.uniform(0.5, 2)}),
          Warp(Affine{linear, random.direction()})};
}

}  // namespace

TEST_CASE("a bend keeps the ends where they are and its arc has the stated angle and length") {
  const Bend bend{Vec3(1, 0, 0), Vec3(1, 2, 0), Vec3(1, 0, 0), 60};
  const Warp warp(bend, Box{Vec3(-1), Vec3(1)});
  // A chord of 2 under 60 degrees: radius 2, arc 2 pi / 3.
  const double arc = 2 * std::numbers::pi / 3;
  CHECK(arc_length(bend) == Approx(arc));
  const Vec3 base = warp.map(bend.base), tip = warp.map(bend.tip);
  CHECK(glm::distance(base, bend.base) < 1e-12);
  CHECK(glm::distance(tip, bend.base + Vec3(0, arc, 0)) < 1e-12);
  // The arc's middle bulges by its sagitta towards the direction.
  const Vec3 middle = warp.map(Vec3(1 + 2 * (1 - std::cos(std::numbers::pi / 6)), 1, 0));
  CHECK(glm::distance(middle, bend.base + Vec3(0, arc / 2, 0)) < 1e-12);
  // The initial tangent is turned by half the angle towards the bulge; straight on before the base.
  const Vec3 before =
      warp.map(bend.base - 0.5 * Vec3(std::sin(std::numbers::pi / 6), std::cos(std::numbers::pi / 6), 0));
  CHECK(glm::distance(before, bend.base - Vec3(0, 0.5, 0)) < 1e-12);
}

TEST_CASE("Jacobians of warps are the limits of differences") {
  RandomSource random(21);
  for (int i = 0; i < 200; ++i) {
    for (const Warp& warp : some_warps(random)) {
      const Vec3 p = random.in_box({Vec3(-0.8), Vec3(0.8)});
      const Mat3 jacobian = warp.map_with_jacobian(p).jacobian;
      for (int axis = 0; axis < 3; ++axis) {
        const double h = 1e-6;
        Vec3 step(0);
        step[axis] = h;
        const Vec3 there = warp.map(p + step), back = warp.map(p - step);
        const Vec3 one_sided = (there - warp.map(p)) / h;
        const Vec3 column = (there - back) / (2 * h);
        if (glm::distance(one_sided, column) > 1e-4) continue;  // a kink: where a bend or taper ends
        CHECK(glm::distance(jacobian[axis], column) < 1e-5);
      }
    }
  }
}

TEST_CASE("the image of a box holds the images of its points, and stretches bound their distances") {
  RandomSource random(22);
  for (int i = 0; i < 500; ++i) {
    for (const Warp& warp : some_warps(random)) {
      const Vec3 a = random.in_box({Vec3(-1), Vec3(1)});
      const Vec3 extent = std::pow(10.0, random.uniform(-2, 0)) * Vec3(random.unit(), random.unit(), random.unit());
      const Box box{a - extent, a + extent};
      const WarpedBox image = warp.map(box);
      for (int k = 0; k < 20; ++k) {
        const Vec3 p = random.in_box(box);
        const WarpedPoint w = warp.map_with_jacobian(p);
        REQUIRE(grown(image.box, 1e-9).contains(w.point));
        REQUIRE(glm::length(w.jacobian * random.direction()) <= image.stretch * (1 + 1e-9));
      }
    }
  }
}

TEST_CASE("a warp's support holds every point that comes from the child's") {
  RandomSource random(23);
  for (int i = 0; i < 500; ++i) {
    for (const Warp& warp : some_warps(random)) {
      const Box child{Vec3(-0.5), Vec3(0.5)};
      const Box support = warp.support(child);
      for (int k = 0; k < 50; ++k) {
        const Vec3 p = random.in_box({Vec3(-3), Vec3(3)});
        if (child.contains(warp.map(p))) REQUIRE(grown(support, 1e-9).contains(p));
      }
    }
  }
}
