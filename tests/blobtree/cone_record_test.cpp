#include "blobtree/cone_record.h"

#include <catch2/catch.hpp>

#include "blobtree/primitive.h"
#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

FadedCone random_cone(RandomSource& random) {
  const auto radius = [&] { return random.uniform(0.05, 0.6); };
  const Vec3 base = random.in_box({Vec3(-1), Vec3(1)});
  // Mostly gentle tapers, as in trees; some so steep that the limits of the radius are at work.
  const double r0 = radius(), r1 = random.chance(0.7) ? r0 * random.uniform(0.8, 1.1) : radius();
  return {base,
          base + random.uniform(0.1, 2) * random.direction(),
          r0,
          r1,
          random.chance(0.6) ? radius() : 0,
          random.chance(0.6) ? radius() : 0};
}

}  // namespace

TEST_CASE("bounds along a piece of a ray hold at every point of it") {
  RandomSource random(51);
  int tight = 0, steady = 0;
  for (int i = 0; i < 20000; ++i) {
    const FadedCone faded = random_cone(random);
    const Cone plain{faded.base, faded.tip, faded.base_radius, faded.tip_radius};
    const bool is_faded = i % 2 == 0;
    const ConeKind kind = is_faded ? ConeKind::kFaded : ConeKind::kPlain;
    const ConeRecord record = is_faded ? record_of(faded, 1) : record_of(plain, 1);
    // Every tenth ray runs along the axis.
    const Vec3 axis = glm::normalize(faded.tip - faded.base);
    const Ray ray{random.in_box({Vec3(-2), Vec3(2)}), i % 10 == 0 ? axis : random.direction()};
    const double start = random.uniform(-2, 1), length = std::pow(10.0, random.uniform(-2, 0.5));
    const Interval range{start, start + length};
    const ConeBounds bounds = bounds_along(record, kind, {}, ray, range);
    const FieldBounds& field = bounds.field;
    steady += bounds.steady;
    double lowest = 2, highest = 0;
    for (int k = 0; k <= 40; ++k) {
      const double t = range.lo + length * k / 40;
      const FieldSample at = is_faded ? sample(faded, ray.at(t)) : sample(plain, ray.at(t));
      lowest = std::min(lowest, at.value);
      highest = std::max(highest, at.value);
      CAPTURE(i, k, is_faded, at.value, field.value.lo, field.value.hi, field.slope, t);
      REQUIRE(at.value <= field.value.hi + 1e-5);
      REQUIRE(at.value >= field.value.lo - 1e-5);
      REQUIRE(glm::length(at.gradient) <= field.slope * (1 + 1e-4) + 1e-4);
    }
    tight += field.value.hi - highest < 0.05;
  }
  // Exact but for the fades, whose range is taken for itself.
  CHECK(tight > 12000);
  CHECK(steady > 200);
}

TEST_CASE("what is bounded along a chord holds on a curve beside it") {
  RandomSource random(52);
  for (int i = 0; i < 4000; ++i) {
    const FadedCone cone = random_cone(random);
    const Ray ray{random.in_box({Vec3(-1.5), Vec3(1.5)}), random.direction()};
    const Interval range{0, random.uniform(0.05, 1)};
    const double slack = random.uniform(0, 0.2);
    const FieldBounds field = bounds_along(record_of(cone, 1), ConeKind::kFaded, {}, ray, range, slack).field;
    for (int k = 0; k < 30; ++k) {
      const Vec3 p = ray.at(random.uniform(range.lo, range.hi)) + slack * random.uniform(0, 1) * random.direction();
      CAPTURE(i, k, slack);
      REQUIRE(sample(cone, p).value <= field.value.hi + 1e-5);
      REQUIRE(sample(cone, p).value >= field.value.lo - 1e-5);
    }
  }
}
