#include "blobtree/primitive.h"

#include <catch2/catch.hpp>

#include "blobtree/cone_record.h"
#include "blobtree/falloff.h"
#include "blobtree/primitive_bounds.h"
#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

TEST_CASE("the falloff has the values of the theory") {
  CHECK(falloff(0) == 1);
  CHECK(falloff(0.25) == 0.5);
  CHECK(falloff(1) == 0);
  CHECK(falloff(7) == 0);
  CHECK(falloff_slope(1) == 0);
  for (int i = 0; i <= 1000; ++i) {
    const double u = i / 1000.0, v = u * u;
    CHECK(falloff(v) == Approx(1 - 22.0 / 9 * v + 17.0 / 9 * v * v - 4.0 / 9 * v * v * v).margin(1e-15));
    CHECK(falloff_slope(v) == Approx(-22.0 / 9 + 34.0 / 9 * v - 12.0 / 9 * v * v).margin(1e-14));
    CHECK(std::abs(2 * u * falloff_slope(v)) <= kSteepestFalloff);
  }
  CHECK(2 * kSteepestDistance * -falloff_slope(kSteepestDistance * kSteepestDistance) ==
        Approx(kSteepestFalloff).epsilon(1e-5));
}

TEST_CASE("a cone's field is the largest field of the spheres along its axis") {
  RandomSource random(11);
  for (int i = 0; i < 200; ++i) {
    const Cone cone{random.in_box({Vec3(-1), Vec3(1)}), random.in_box({Vec3(-1), Vec3(1)}), random.uniform(0.05, 1),
                    random.uniform(0.05, 1)};
    const Vec3 p = random.in_box({Vec3(-2), Vec3(2)});
    double largest = 0;
    const int steps = 4000;
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const Sphere sphere{cone.base + t * (cone.tip - cone.base),
                          cone.base_radius + t * (cone.tip_radius - cone.base_radius)};
      largest = std::max(largest, sample(sphere, p).value);
    }
    CHECK(sample(cone, p).value == Approx(largest).margin(2e-6));
    CHECK(sample(cone, p).value >= largest - 1e-12);
  }
}

TEST_CASE("a cone of equal ends is a sphere of the larger radius") {
  const Cone cone{Vec3(1, 2, 3), Vec3(1, 2, 3), 0.5, 0.8};
  CHECK(sample(cone, Vec3(1.8, 2, 3)).value == Approx(0.5));
  CHECK(sample(cone, Vec3(1, 2, 3)).value == 1);
}

TEST_CASE("a faded cone with free ends and a gentle taper is the plain cone") {
  RandomSource random(12);
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = random.in_box({Vec3(-1), Vec3(1)});
    const double r = random.uniform(0.1, 0.3);
    const Cone cone{a, a + random.uniform(0.5, 1.5) * random.direction(), r, r * random.uniform(0.9, 1.1)};
    const FadedCone faded{cone.base, cone.tip, cone.base_radius, cone.tip_radius, 0, 0};
    const Vec3 p = random.in_box({a - Vec3(1), a + Vec3(1)});
    CHECK(sample(faded, p).value == Approx(sample(cone, p).value).margin(1e-12));
  }
}

TEST_CASE("the surface of a primitive alone lies at its radius from its skeleton") {
  const Disc disc{Vec3(0), Vec3(0, 1, 0), 1, 0.25};
  CHECK(sample(disc, Vec3(0.5, 0.25, 0)).value == Approx(0.5));
  CHECK(sample(disc, Vec3(1.25, 0, 0)).value == Approx(0.5));
  CHECK(sample(disc, Vec3(0)).value == 1);
  const Ring ring{Vec3(0), Vec3(0, 1, 0), 1, 0.25};
  CHECK(sample(ring, Vec3(0.75, 0, 0)).value == Approx(0.5));
  CHECK(sample(ring, Vec3(0, 0.25, 1)).value == Approx(0.5));
  CHECK(sample(ring, Vec3(0)).value == 0);
  const Polygon arrow{{Vec3(0), Vec3(2, 0, 2), Vec3(1, 0, 0), Vec3(2, 0, -2)}, 0.1};
  CHECK(sample(arrow, Vec3(0.5, 0.1, 0)).value == Approx(0.5));
  CHECK(sample(arrow, Vec3(-0.1, 0, 0)).value == Approx(0.5));
  CHECK(sample(arrow, Vec3(1.8, 0, 0)).value == 0);  // in the notch
}

TEST_CASE("bounds of a faded cone hold for extreme tapers") {
  RandomSource random(13);
  for (int i = 0; i < 3000; ++i) {
    const double r0 = random.uniform(0.05, 1), r1 = random.uniform(0.05, 1);
    const FadedCone cone{
        Vec3(0), random.uniform(0.02, 2) * random.direction(),     r0,
        r1,      random.chance(0.5) ? random.uniform(0.05, 1) : 0, random.chance(0.5) ? random.uniform(0.05, 1) : 0};
    const ConeRecord record = record_of(cone, 1);
    const Box support = support_of(cone);
    const Vec3 a = random.in_box({Vec3(-3), Vec3(3)});
    const Vec3 extent = std::pow(10.0, random.uniform(-3, 0.3)) * Vec3(random.unit(), random.unit(), random.unit());
    const Box box{a - extent, a + extent};
    const FieldBounds bounds = bounds_where_supported(
        support, box, [&](const Box& part) { return bounds_of(record, ConeKind::kFaded, {}, part).field; });
    for (int k = 0; k < 20; ++k) {
      const FieldSample s = sample(cone, random.in_box(box));
      CAPTURE(i, r0, r1, record.length, cone.parent_radius, cone.child_radius);
      REQUIRE(s.value <= bounds.value.hi + 1e-12);
      REQUIRE(s.value >= bounds.value.lo - 1e-12);
      REQUIRE(glm::length(s.gradient) <= bounds.slope * (1 + 1e-9) + 1e-9);
    }
  }
}
