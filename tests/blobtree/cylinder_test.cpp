#include "blobtree/cylinder.h"

#include <catch2/catch.hpp>

#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

Cylinder random_cylinder(RandomSource& random) {
  return {random.in_box({Vec3(-1), Vec3(1)}), random.direction(), std::pow(10.0, random.uniform(-2, 1)),
          std::pow(10.0, random.uniform(-2, 0))};
}

bool contains(const Cylinder& c, const Vec3& p) {
  const double y = glm::dot(p - c.center, c.axis);
  return std::abs(y) <= c.half_length && glm::length(p - c.center - y * c.axis) <= c.radius;
}

Vec3 random_point(const Cylinder& c, RandomSource& random) {
  Vec3 u, v;
  complete_frame(c.axis, u, v);
  const double angle = random.uniform(0, 6.2831853), rho = c.radius * std::sqrt(random.uniform(0, 1));
  return c.center + random.uniform(-1, 1) * c.half_length * c.axis + rho * (std::cos(angle) * u + std::sin(angle) * v);
}

}  // namespace

TEST_CASE("a cylinder's box holds it, and a ray's part in it is all that is in it") {
  RandomSource random(71);
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Cylinder cylinder = random_cylinder(random);
    const Vec3 target = random_point(cylinder, random);
    CHECK(grown(box_around(cylinder), 1e-12).contains(target));
    // Some rays are parallel to the axis, or across it; some come from far away.
    Vec3 u, v;
    complete_frame(cylinder.axis, u, v);
    const Vec3 direction = i % 5 == 0 ? cylinder.axis : i % 5 == 1 ? u : random.direction();
    const double before = std::pow(10.0, random.uniform(-1, 4));
    const Ray ray{target - before * direction, direction};
    const Interval range{0, 2 * before}, part = clip(ray, cylinder, range);
    for (int k = 0; k < 40; ++k) {
      const double t = before + random.uniform(-2, 2) * (cylinder.radius + cylinder.half_length);
      if (!range.contains(t) || !contains(cylinder, ray.at(t))) continue;
      ++inside;
      CAPTURE(i, t, part.lo, part.hi);
      REQUIRE(part.lo <= t + 1e-9 * before);
      REQUIRE(t <= part.hi + 1e-9 * before);
    }
  }
  CHECK(inside > 4000);
}

TEST_CASE("cylinders that share a point may overlap, also nearly parallel ones known to single precision") {
  RandomSource random(72);
  int apart = 0;
  for (int i = 0; i < 20000; ++i) {
    const Cylinder a = random_cylinder(random);
    Cylinder b = random_cylinder(random);
    if (i % 2 == 0) b.axis = glm::normalize(a.axis + std::pow(10.0, random.uniform(-8, -2)) * random.direction());
    b.axis = Vec3(glm::vec3(b.axis));
    const Vec3 shared = random_point(a, random);
    b.center += shared - random_point(b, random);
    CAPTURE(i, a.half_length, a.radius, b.half_length, b.radius);
    REQUIRE(may_overlap(a, b));
    b.center += random.uniform(0, 6) * (a.radius + b.radius) * random.direction();
    apart += !may_overlap(a, b);
  }
  CHECK(apart > 2000);
}
