// Displaced surfaces, against closed forms. [docs/field.md, "Displacement"]

#include <array>
#include <catch2/catch.hpp>

#include "base/noise.h"
#include "blobtree/falloff.h"
#include "blobtree/from_skeleton.h"
#include "blobtree/noise_kernels.h"
#include "blobtree/solid_noise.h"
#include "tests/blobtree/instruction_sets.h"
#include "tests/support/random_source.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

SolidNoise random_noise(RandomSource& random) {
  SolidNoise noise;
  noise.wavelength = random.uniform(0.2, 2);
  noise.stretch = random.uniform(0.5, 8);
  noise.octaves = random.integer(1, 5);
  noise.ridged = random.chance(0.5);
  noise.seed = random.integer(0, 1 << 30);
  return noise;
}

double value_at(const Field& field, const Vec3& p) {
  double value = 0;
  field.values({&p, 1}, {&value, 1});
  return value;
}

// Where a field that falls along a line from inside crosses the iso-value.
double crossing(const Field& field, const Vec3& origin, const Vec3& direction, double inside, double outside) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (value_at(field, origin + middle * direction) >= kIsoValue ? inside : outside) = middle;
  }
  return inside;
}

BlobTree displaced_capsule(double amount, const SolidNoise& noise, double radius) {
  BlobTree tree;
  tree.add(Displacement{amount, noise}, {tree.add(Cone{Vec3(0), Vec3(0, 20, 0), radius, radius})});
  return tree;
}

}  // namespace

TEST_CASE("the surface of a displaced straight limb lies where g(u) (1 + a n) is the iso-value, within its bounds") {
  RandomSource random(1);
  double lowest = 9, highest = 0;
  for (int i = 0; i < 60; ++i) {
    const SolidNoise noise = random_noise(random);
    const double radius = random.uniform(0.2, 2), amount = random.uniform(0, 0.49);
    const double most = 2 * radius * falloff_distance(kIsoValue / (1 + amount));
    const double least = 2 * radius * falloff_distance(kIsoValue / (1 - amount));
    const BlobTree tree = displaced_capsule(amount, noise, radius);
    for (const auto& field : {reference_field(tree), compile(tree)}) {
      for (int k = 0; k < 20; ++k) {
        const double turn = random.uniform(0, 6.28);
        const Vec3 origin(0, random.uniform(5, 15), 0), out(std::cos(turn), 0, std::sin(turn));
        const double distance = crossing(*field, origin, out, 0, 2 * radius);
        const double n = sample(noise, origin + distance * out).value;
        CAPTURE(i, k, amount, n);
        CHECK(distance / radius == Approx(2 * falloff_distance(kIsoValue / (1 + amount * n))).margin(2e-5));
        CHECK(distance >= least - 1e-5 * radius);
        CHECK(distance <= most + 1e-5 * radius);
        lowest = std::min(lowest, distance / radius);
        highest = std::max(highest, distance / radius);
      }
    }
  }
  CHECK(lowest < 0.8);
  CHECK(highest > 1.15);
}

TEST_CASE("noise of a wavelength much larger than the limb changes nothing but its radius") {
  SolidNoise noise;
  noise.wavelength = 1e5;
  noise.octaves = 1;
  const Vec3 far(31e3, -2e3, 55e3);
  const double n = sample(noise, far).value;
  REQUIRE(std::abs(n) > 0.1);
  BlobTree tree;
  tree.add(Displacement{0.4, noise}, {tree.add(Cone{far, far + Vec3(3, 0, 0), 1, 1})});
  const double expected = 2 * falloff_distance(kIsoValue / (1 + 0.4 * n));
  for (const auto& field : {reference_field(tree), compile(tree)}) {
    for (int k = 0; k < 16; ++k) {
      const Vec3 out(0, std::cos(k), std::sin(k));
      CHECK(crossing(*field, far + Vec3(1.5, 0, 0), out, 0, 2) == Approx(expected).margin(1e-4));
    }
  }
}

TEST_CASE("solid noise stays between -1 and 1, comes near both, and knows its slope") {
  for (const bool ridged : {false, true}) {
    RandomSource random(2);
    double lowest = 0, highest = 0;
    for (int i = 0; i < 20000; ++i) {
      SolidNoise noise = random_noise(random);
      noise.ridged = ridged;
      const Vec3 p = random.in_box({Vec3(-20), Vec3(20)});
      const Graded at = sample(noise, p);
      lowest = std::min(lowest, at.value);
      highest = std::max(highest, at.value);
      if (i % 20 != 0) continue;
      constexpr double kStep = 1e-6;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 step(0);
        step[axis] = kStep;
        const double difference = (sample(noise, p + step).value - sample(noise, p - step).value) / (2 * kStep);
        CHECK(at.slope[axis] == Approx(difference).margin(1e-3).epsilon(1e-4));
      }
    }
    CHECK(lowest >= -1);
    CHECK(highest <= 1);
    CHECK(lowest < -0.6);
    CHECK(highest > 0.6);
  }
}

TEST_CASE("bounds of noise hold around a point, for its second derivative too, and close in on it") {
  RandomSource random(3);
  for (int i = 0; i < 600; ++i) {
    const SolidNoise noise = random_noise(random);
    const Vec3 center = random.in_box({Vec3(-20), Vec3(20)});
    const double distance = noise.wavelength * std::pow(10, random.uniform(-5, 0.5));
    const FieldBounds bounds = bounds_of(noise, center, distance);
    for (int k = 0; k < 30; ++k) {
      const Vec3 p = center + random.unit() * distance * random.direction(), along = random.direction();
      const Graded at = sample(noise, p);
      CAPTURE(i, k, distance, at.value, bounds.value.lo, bounds.value.hi);
      REQUIRE(bounds.value.contains(at.value));
      REQUIRE(glm::length(at.slope) <= bounds.slope);
      const double step = 1e-6 * noise.wavelength;
      const double second =
          glm::dot(sample(noise, p + step * along).slope - sample(noise, p - step * along).slope, along) / (2 * step);
      const double scale = std::max(-bounds.second.lo, bounds.second.hi);
      REQUIRE(second >= bounds.second.lo - 1e-5 * scale);
      REQUIRE(second <= bounds.second.hi + 1e-5 * scale);
    }
    const FieldBounds close = bounds_of(noise, center, 1e-8 * noise.wavelength);
    REQUIRE(close.value.hi - close.value.lo < 1e-4);
  }
}

TEST_CASE("every instruction set agrees with the plain formulas of noise, however far from the world's origin") {
  const int sets = on_every_instruction_set([] {
    RandomSource random(4);
    constexpr std::size_t kPoints = 48;
    for (int i = 0; i < 300; ++i) {
      const SolidNoise noise = random_noise(random);
      const double scale = 0.125, far = std::pow(10, random.uniform(0, 7));
      const Vec3 origin = random.in_box({Vec3(-far), Vec3(far)});
      std::array<std::array<float, kPoints>, 3> p;
      std::array<std::array<float, kPoints>, 4> out;
      std::array<float, kPoints> alone;
      for (auto& column : p) {
        for (float& x : column) x = static_cast<float>(scale * random.uniform(-3, 3));
      }
      const PointBatch points{origin, {p[0].data(), p[1].data(), p[2].data()}, kPoints};
      sample_noise(noise, scale, points, {out[0].data(), {out[1].data(), out[2].data(), out[3].data()}});
      sample_noise(noise, scale, points, {alone.data(), {}});
      for (std::size_t k = 0; k < kPoints; ++k) {
        // What rounding a point by the last of its digits may do.
        const double finest = noise.wavelength * std::min(1.0, noise.stretch) / std::exp2(noise.octaves - 1);
        const double rounding = 2e-5 + 1e-5 / finest;
        const Graded expected = sample(noise, origin + Vec3(p[0][k], p[1][k], p[2][k]) / scale);
        CAPTURE(i, k, far, expected.value, out[0][k]);
        REQUIRE(std::abs(out[0][k] - expected.value) <= rounding);
        REQUIRE(alone[k] == out[0][k]);
        const Vec3 gradient = scale * Vec3(out[1][k], out[2][k], out[3][k]);
        REQUIRE(glm::distance(gradient, expected.slope) <= 40 * rounding / finest);
      }
    }
  });
  CHECK(sets >= 2);
}

TEST_CASE("a plant without an amount has no displacement, and twigs have none") {
  const Skeleton skeleton = random_skeleton(5, 20);
  TreeOptions options;
  CHECK(finest_wavelength(tree_from_skeleton(skeleton, options)) == std::numeric_limits<double>::infinity());
  options.displacement.amount = 0.3;
  options.displacement.wavelength = 0.8;
  options.displacement.octaves = 3;
  CHECK(finest_wavelength(tree_from_skeleton(skeleton, options)) == Approx(0.2));
  options.displacement.furrowed_radius = 1e3;
  CHECK(tree_from_skeleton(skeleton, options) == tree_from_skeleton(skeleton));
}

TEST_CASE("a displaced plant keeps its internodes' primitives, bent or not") {
  TreeOptions options;
  options.displacement.amount = 0.3;
  options.displacement.furrowed_radius = 1e-3;
  options.bend_angle_degrees = 25;
  const PlantTree plant = plant_from_skeleton(random_skeleton(6, 20), options);
  std::size_t displacements = 0;
  for (const Node& node : plant.tree.nodes) displacements += std::holds_alternative<Displacement>(node.what);
  CHECK(displacements == plant.primitives.size());
  for (const NodeId primitive : plant.primitives)
    CHECK(std::holds_alternative<FadedCone>(plant.tree.nodes[primitive].what));
}

TEST_CASE("a displacement outside its range is refused") {
  TreeOptions options;
  for (const double amount : {-0.1, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    options.displacement.amount = amount;
    CHECK_THROWS(tree_from_skeleton(junction({{30, 0, 0.5}}), options));
  }
  options.displacement.amount = 0.2;
  options.displacement.wavelength = 0;
  CHECK_THROWS(tree_from_skeleton(junction({{30, 0, 0.5}}), options));
  CHECK_THROWS(parse_tree("displacement(amount = 1) { cone() }", "x"));
  CHECK_THROWS(parse_tree("displacement(octaves = 9) { cone() }", "x"));
  CHECK_THROWS(parse_tree("displacement(octaves = 1.5) { cone() }", "x"));
  CHECK_THROWS(parse_tree("displacement", "x"));
}

TEST_CASE("the face of a cut through a displaced branch is plane") {
  Skeleton skeleton = junction({{0, 0, 1}});
  skeleton.cut_ends.push_back({1, glm::normalize(Vec3(0.3, 1, 0.1)), 0});
  TreeOptions options;
  options.displacement.amount = 0.4;
  options.displacement.ridged = false;
  const auto field = compile(tree_from_skeleton(skeleton, options));
  const Vec3 tip = skeleton.internodes[1].tip, normal = skeleton.cut_ends[0].normal;
  RandomSource random(7);
  double nearest_edge = 9, farthest_edge = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 side = glm::normalize(glm::cross(normal, random.direction()));
    const Vec3 p = tip + random.uniform(0, 0.7) * side;
    CHECK(value_at(*field, p - 1e-4 * normal) >= kIsoValue);
    CHECK(value_at(*field, p + 1e-4 * normal) < kIsoValue);
    const double edge = crossing(*field, tip - 1e-3 * normal, side, 0, 2);
    nearest_edge = std::min(nearest_edge, edge);
    farthest_edge = std::max(farthest_edge, edge);
  }
  CHECK(farthest_edge - nearest_edge > 0.1);  // while its outline is not a circle's
}
