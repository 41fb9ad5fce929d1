#include "raytrace/tracer.h"

#include <catch2/catch.hpp>
#include <string>

#include "base/random.h"
#include "tests/raytrace/dense_march.h"
#include "tests/raytrace/test_fields.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

struct NamedField {
  std::string name;
  FieldPtr field;
};

// A heap of balls that blend, some thin.
FieldPtr heap(std::uint64_t seed, int count) {
  std::vector<FieldPtr> parts;
  for (int i = 0; i < count; ++i) {
    const Vec3 center(random_unit(seed, i, 0), random_unit(seed, i, 1), random_unit(seed, i, 2));
    parts.push_back(ball(2.0 * center - 1.0, 0.02 + 0.3 * std::pow(random_unit(seed, i, 3), 3)));
  }
  return sum(std::move(parts));
}

std::vector<NamedField> test_models() {
  const FieldPtr lens = smallest({ball({-0.8, 0, 0}, 1), ball({0.8, 0, 0}, 1)});
  const FieldPtr creased = largest({torus({0, 0, 0}, 1, 0.3), ball({1, 0.1, 0}, 0.45), ball({-0.4, 0, 0.9}, 0.5)});
  return {{"a ball", ball({0.2, -0.1, 0.3}, 0.7)},
          {"a torus", torus({0, 0, 0}, 1, 0.2)},
          {"two balls that just touch", sum({ball({-1, 0, 0}, 0.5), ball({1.0, 0, 0}, 0.5)})},
          {"a heap of balls", heap(1, 40)},
          {"a lens", lens},
          {"a creased union", creased},
          {"a sum of creases", sum({lens, creased, ball({0, 1.2, 0}, 0.3)})}};
}

Vec3 random_direction(std::uint64_t seed, int i) {
  const double z = 2 * random_unit(seed, i, 1) - 1, angle = 2 * M_PI * random_unit(seed, i, 2);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Rays into the support's box from around it, and a third of them tangent to the surface at a random place.
Ray random_ray(const Field& field, const Tracer& tracer, std::uint64_t seed, int i) {
  const Box box = field.support();
  const Vec3 u(random_unit(seed, i, 4), random_unit(seed, i, 5), random_unit(seed, i, 6));
  Ray ray{box.lo + u * (box.hi - box.lo), random_direction(seed, i)};
  const double back = box.diagonal() * (0.5 + 3 * random_unit(seed, i, 7));
  ray.origin -= back * ray.direction;
  if (i % 3 == 0) {
    if (const auto hit = tracer.first_hit(ray)) {
      const Vec3 tangent = glm::normalize(glm::cross(hit->normal, random_direction(seed + 1, i)));
      const double lift = box.diagonal() * std::pow(10, -9 + 7 * random_unit(seed, i, 8));
      return {hit->point + hit->normal * (i % 2 == 0 ? lift : -lift) - back * tangent, tangent};
    }
  }
  return ray;
}

double value_at(const Field& field, const Vec3& p) {
  double value = 0;
  field.values({&p, 1}, {&value, 1});
  return value;
}

}  // namespace

TEST_CASE("the tracer agrees with a dense march on random and grazing rays") {
  const int rays = 15000;
  for (const NamedField& model : test_models()) {
    INFO(model.name);
    const Tracer tracer(*model.field);
    const double size = model.field->support().diagonal();
    int hits = 0, wrong = 0, unequal_shadow = 0;
    double worst = 0;
    for (int i = 0; i < rays; ++i) {
      const Ray ray = random_ray(*model.field, tracer, 11, i);
      const auto hit = tracer.first_hit(ray);
      const auto expected = dense_march(*model.field, ray, 300);
      if (hit.has_value() != tracer.occluded(ray)) ++unequal_shadow;
      if (hit) {
        ++hits;
        if (value_at(*model.field, hit->point) < kIsoValue - 1e-9) ++wrong;
      }
      if (expected) {
        if (!hit) {
          // Only what is thinner along the ray than the tolerance may be missed.
          const Vec3 beyond = ray.at(*expected + 2 * tracer.tolerance());
          if (value_at(*model.field, beyond) >= kIsoValue) ++wrong;
        } else {
          worst = std::max(worst, hit->t - *expected);
        }
      }
    }
    CHECK(hits > rays / 40);
    CHECK(wrong == 0);
    CHECK(unequal_shadow == 0);
    CHECK(worst < 1e-9 * size);
  }
}

TEST_CASE("a ball is hit where its equation says, at every scale, place and distance") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double distance : {3.0, 1e5}) {
      const Vec3 center = scale * Vec3(7, -20, 3);
      const Tracer tracer(*ball(center, scale));
      int wrong = 0;
      for (int i = 0; i < 2000; ++i) {
        // Aimed at a point beside the center, from the offset's plane: the closed form is plain.
        const Vec3 d = random_direction(5, i);
        Vec3 u, v;
        complete_frame(d, u, v);
        const double b = 1.1 * scale * random_unit(6, i);
        const Ray ray{center + b * u - distance * scale * d, d};
        const auto hit = tracer.first_hit(ray);
        const double half = std::sqrt(std::max(0.0, scale * scale - b * b));
        if (std::abs(b / scale - 1) < 1e-9) continue;
        if (hit.has_value() != (b < scale)) ++wrong;
        if (!hit || half < 1e-3 * scale) continue;
        const Vec3 exact = center + b * u - half * d;
        if (std::abs(hit->t - (distance * scale - half)) > 1e-11 * scale * distance) ++wrong;
        if (glm::length(hit->point - exact) > 1e-9 * scale) ++wrong;
        if (glm::length(hit->normal - (exact - center) / scale) > 1e-9) ++wrong;
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("a speck of a millionth of the scene is not stepped over") {
  const double radius = 1e-6;
  const FieldPtr field = sum({ball({0, 0, 0}, 0.3), ball({0.9, 0.1, 0.05}, radius), ball({1, 1, 1}, 0.1)});
  const Tracer tracer(*field);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    Vec3 u, v;
    const Vec3 d = random_direction(8, i);
    complete_frame(d, u, v);
    const Vec3 aim = Vec3(0.9, 0.1, 0.05) + 0.9 * radius * random_unit(9, i) * u;
    const auto hit = tracer.first_hit({aim - 0.01 * d, d}, 0, 0.02);
    if (hit && glm::length(hit->point - aim) < 1.01 * radius) ++hits;
  }
  CHECK(hits == 1000);
}

TEST_CASE("the range of a ray is respected, and a ray that starts inside hits at once") {
  const Tracer tracer(*ball({0, 0, 0}, 1));
  const Ray ray{{-3, 0.1, 0}, {1, 0, 0}};
  const double near = 3 - std::sqrt(0.99), far = 3 + std::sqrt(0.99);
  CHECK(tracer.first_hit(ray, 0, near - 1e-6) == std::nullopt);
  CHECK(tracer.first_hit(ray, far + 1e-6) == std::nullopt);
  CHECK_FALSE(tracer.occluded(ray, 0, near - 1e-6));
  CHECK_FALSE(tracer.occluded(ray, far + 1e-6));
  CHECK(tracer.occluded(ray, 0, near + 1e-6));
  CHECK(tracer.first_hit(ray, 2.5)->t == 2.5);
  CHECK(tracer.first_hit({{0, 0, 0.5}, {0, 0, -1}})->t == 0);
  CHECK(tracer.occluded({{0, 0, 0.5}, {0, 0, -1}}));
}

TEST_CASE("rays along the faces and edges of cells hit like others") {
  const Tracer tracer(*ball({0, 0, 0}, 1));
  for (const double y : {-0.5, 0.0, 0.25, 0.5}) {
    for (const double z : {-0.5, 0.0, 0.25, 0.5}) {
      const auto hit = tracer.first_hit({{-5, y, z}, {1, 0, 0}});
      REQUIRE(hit);
      CHECK(hit->t == Approx(5 - std::sqrt(1 - y * y - z * z)).epsilon(1e-12));
    }
  }
}

TEST_CASE("an empty field is never hit") {
  for (const FieldPtr& field : {sum({}), smallest({ball({0, 0, 0}, 0.1), ball({1, 0, 0}, 0.1)})}) {
    const Tracer tracer(*field);
    CHECK_FALSE(tracer.first_hit({{0, 0, 5}, {0, 0, -1}}));
    CHECK_FALSE(tracer.occluded({{0, 0, 5}, {0, 0, -1}}));
    CHECK(tracer.scene_box().empty());
  }
}

TEST_CASE("a ray that leaves a hit's outside point meets the same convex surface no more") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Tracer tracer(*ball(scale * Vec3(3, 5, -2), scale));
    int met = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 d = random_direction(12, i);
      const auto hit = tracer.first_hit({scale * Vec3(3, 5, -2) - 4 * scale * d, d});
      REQUIRE(hit);
      Vec3 u, v;
      complete_frame(hit->normal, u, v);
      // From straight up to nearly tangent.
      const double sine = std::sin(M_PI / 2 * random_unit(13, i)), cosine = std::sqrt(1 - sine * sine);
      if (tracer.occluded({hit->outside_point(), sine * u + cosine * hit->normal})) ++met;
      CHECK(hit->clearance < 1e-3 * scale);
    }
    CHECK(met == 0);
  }
}
