#include "base/noise.h"

#include <catch2/catch.hpp>

#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

template <typename Function>
Vec3 differences(const Function& value_at, const Vec3& p) {
  constexpr double kStep = 1e-5;
  Vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0);
    step[axis] = kStep;
    slope[axis] = (value_at(p + step) - value_at(p - step)) / (2 * kStep);
  }
  return slope;
}

}  // namespace

TEST_CASE("noise is zero on the lattice, has mean zero, and stays within its bound") {
  RandomSource random(1);
  double sum = 0, most = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = random.in_box({Vec3(-50), Vec3(50)});
    const double value = gradient_noise(p, 7).value;
    sum += value;
    most = std::max(most, std::abs(value));
    CHECK(gradient_noise(glm::floor(p), 7).value == 0);
  }
  CHECK(std::abs(sum / 20000) < 0.01);
  CHECK(most < 1.04);
  CHECK(most > 0.6);
}

TEST_CASE("noise knows its slope, also across the lattice's planes") {
  RandomSource random(2);
  for (int i = 0; i < 500; ++i) {
    Vec3 p = random.in_box({Vec3(-5), Vec3(5)});
    if (i % 3 == 0) p.y = std::round(p.y);
    const Vec3 scale(2, 0.3, 1.5);
    const Vec3 plain = differences([](const Vec3& q) { return gradient_noise(q, 3).value; }, p);
    CHECK(glm::distance(gradient_noise(p, 3).slope, plain) < 1e-5);
    const Vec3 layered = differences([&](const Vec3& q) { return layered_noise(q, scale, 3, 0.01, 3).value; }, p);
    CHECK(glm::distance(layered_noise(p, scale, 3, 0.01, 3).slope, layered) < 1e-5);
  }
}

TEST_CASE("graded formulas have the slopes of their values") {
  RandomSource random(4);
  const auto formula = [](const Vec3& q) {
    const Graded x(q.x, {1, 0, 0}), y(q.y, {0, 1, 0}), z(q.z, {0, 0, 1});
    return mix(abs(x) * y - z, sqrt(Graded(2) + max(x, y)), smooth_step(-1, 2, min(y, z)) / 2);
  };
  int smooth = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random.in_box({Vec3(-1), Vec3(1)});
    const Vec3 slope = differences([&](const Vec3& q) { return formula(q).value; }, p);
    smooth += glm::distance(formula(p).slope, slope) < 1e-6;
  }
  CHECK(smooth > 195);  // kinks are rarely met
}
