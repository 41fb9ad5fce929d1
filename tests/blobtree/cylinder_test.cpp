#include "blobtree/cylinder.h"

#include <catch2/catch.hpp>

#include "blobtree/ray_bundle.h"
#include "tests/blobtree/instruction_sets.h"
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

TEST_CASE("a cylinder's box holds it, and rays' parts in it are all that is in it, on every instruction set") {
  on_every_instruction_set([] {
    RandomSource random(71);
    int inside = 0, missed = 0;
    for (int i = 0; i < 1000; ++i) {
      const Cylinder cylinder = random_cylinder(random);
      Vec3 u, v;
      complete_frame(cylinder.axis, u, v);
      RayBundle bundle;
      std::array<double, RayBundle::kWidth> before;
      const auto count = static_cast<std::size_t>(random.integer(1, RayBundle::kWidth));
      for (std::size_t lane = 0; lane < count; ++lane) {
        const Vec3 target = random_point(cylinder, random) + (lane % 4 == 3 ? 2 * cylinder.radius : 0.0) * u;
        if (lane % 4 != 3) CHECK(grown(box_around(cylinder), 1e-12).contains(target));
        // Some rays are parallel to the axis, or across it; some come from far away.
        const std::size_t way = (static_cast<std::size_t>(i) + lane) % 5;
        const Vec3 direction = way == 0 ? cylinder.axis : way == 1 ? u : random.direction();
        before[lane] = std::pow(10.0, random.uniform(-1, 4));
        bundle.add({target - before[lane] * direction, direction}, {0, 2 * before[lane]});
      }
      const RayLanes asked = bundle.lanes() & static_cast<RayLanes>(random.integer(1, 0xffff));
      RayRanges parts;
      const RayLanes met = clip(bundle, asked, cylinder, parts);
      REQUIRE((met & ~asked) == 0);
      missed += std::popcount(asked & ~met);
      for_each_lane(asked, [&](std::size_t lane) {
        const Interval range = bundle.ranges[lane];
        const bool is_met = (met >> lane & 1) != 0;
        if (is_met) REQUIRE((parts.lo[lane] >= range.lo && parts.hi[lane] <= range.hi && !parts[lane].empty()));
        for (int k = 0; k < 40; ++k) {
          const double t = before[lane] + random.uniform(-2, 2) * (cylinder.radius + cylinder.half_length);
          if (!range.contains(t) || !contains(cylinder, bundle.ray(lane).at(t))) continue;
          ++inside;
          CAPTURE(i, lane, t, parts.lo[lane], parts.hi[lane]);
          REQUIRE(is_met);
          REQUIRE(parts.lo[lane] <= t + 1e-9 * before[lane]);
          REQUIRE(t <= parts.hi[lane] + 1e-9 * before[lane]);
        }
      });
    }
    CHECK(inside > 4000);
    CHECK(missed > 100);
  });
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
