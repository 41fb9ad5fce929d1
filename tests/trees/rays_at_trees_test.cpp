// Whole trees under rays, against a march that knows no bounds.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "blobtree/from_skeleton.h"
#include "raytrace/tracer.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// Samples along a ray, all at once.
struct March {
  const Field& field;
  std::vector<Vec3> points;
  std::vector<double> values;

  double value(const Ray& ray, double t) {
    const Vec3 p = ray.at(t);
    double f = 0;
    field.values({&p, 1}, {&f, 1});
    return f;
  }

  double highest(const Ray& ray, double from, double to) {
    double most = 0;
    for (int k = 0; k <= 200; ++k) most = std::max(most, value(ray, from + (to - from) * k / 200));
    return most;
  }

  // The first inside point that `count` samples show, or infinity.
  double first_inside(const Ray& ray, double from, double to, int count) {
    points.resize(static_cast<std::size_t>(count) + 1);
    values.resize(points.size());
    for (int i = 0; i <= count; ++i) points[static_cast<std::size_t>(i)] = ray.at(from + (to - from) * i / count);
    field.values(points, values);
    for (int i = 0; i <= count; ++i) {
      if (values[static_cast<std::size_t>(i)] < kIsoValue) continue;
      if (i == 0) return from;
      double outside = from + (to - from) * (i - 1) / count, inside = from + (to - from) * i / count;
      for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (outside + inside);
        (value(ray, middle) >= kIsoValue ? inside : outside) = middle;
      }
      return inside;
    }
    return std::numeric_limits<double>::infinity();
  }
};

struct Counts {
  int rays = 0, hits = 0, found_only_by_bounds = 0;
  int unequal = 0;  // shadows that hits do not have, or the other way round
};

// What a tracer says of a ray, against what a march finds.
void check_hit(const Ray& ray, const std::optional<Hit>& hit, double expected, double size, March& march,
               Counts& counts) {
  if (!hit) {
    // Grazing rays are told apart by the field's own rounding only.
    if (expected < std::numeric_limits<double>::infinity()) {
      REQUIRE(march.highest(ray, expected, expected + 1e-6 * size) < kIsoValue + 1e-5);
    }
    return;
  }
  ++counts.hits;
  CAPTURE(hit->t);
  const double tolerance = 1e-6 * size;
  // What lies before the hit can only graze, within the field's rounding.
  if (hit->t > expected + tolerance) REQUIRE(march.highest(ray, expected, hit->t - tolerance) < kIsoValue + 1e-5);
  if (hit->t < expected - tolerance) {
    // The samples stepped over a sliver: it must be there.
    ++counts.found_only_by_bounds;
    REQUIRE(march.highest(ray, hit->t - tolerance, hit->t + tolerance) >= kIsoValue - 1e-5);
  }
  REQUIRE(glm::length(hit->normal) == Approx(1));
}

void shoot(const Skeleton& skeleton, const TreeOptions& options, std::uint64_t seed, int rays, Counts& counts) {
  constexpr std::size_t kTogether = Tracer::kMostTogether;
  const auto field = compile(tree_from_skeleton(skeleton, options));
  const Tracer tracer(*field);
  March march{*field, {}, {}};
  const double size = field->support().diagonal();
  RandomSource random(seed);
  for (int i = 0; i < rays; i += static_cast<int>(kTogether)) {
    // At a point near an internode's surface, so that many rays graze; and at its neighbourhood, as those of a pixel or
    // of many.
    const Internode& a =
        skeleton
            .internodes[static_cast<std::size_t>(random.integer(0, static_cast<int>(skeleton.internodes.size()) - 1))];
    const Vec3 target = a.base + random.uniform(-0.1, 1.1) * (a.tip - a.base) +
                        random.uniform(0.7, 1.3) * a.base_radius * random.direction();
    const Vec3 direction = random.direction();
    const double spread = a.base_radius * std::pow(10.0, random.uniform(-3, 1));
    std::array<RayPart, kTogether> together;
    std::array<std::optional<Hit>, kTogether> hits;
    std::array<bool, kTogether> in_shadow;
    for (std::size_t k = 0; k < kTogether; ++k) {
      const Vec3 off = k == 0 ? Vec3(0) : spread * random.direction();
      const Vec3 turned = glm::normalize(direction + (k == 0 ? 0.0 : spread / size) * random.direction());
      together[k].ray = {target + off - size * turned, turned};
    }
    tracer.first_hits(together, hits);
    tracer.occluded(together, in_shadow);
    for (std::size_t k = 0; k < kTogether; ++k) {
      const Ray& ray = together[k].ray;
      const double expected = march.first_inside(ray, 0, 2 * size, 1500);
      ++counts.rays;
      CAPTURE(seed, i, k, expected);
      check_hit(ray, hits[k], expected, size, march, counts);
      if (in_shadow[k] != hits[k].has_value()) ++counts.unequal;
      if (k > 0) continue;
      // The same ray alone.
      const std::optional<Hit> alone = tracer.first_hit(ray);
      Counts ignored;
      check_hit(ray, alone, expected, size, march, ignored);
      if (tracer.occluded(ray) != alone.has_value()) ++counts.unequal;
    }
  }
}

void shoot_at_trees(int trees, int rays_a_tree, int internodes, double displacement = 0) {
  Counts counts;
  for (int i = 0; i < trees; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    TreeOptions options;
    options.junction = i % 2 ? JunctionKind::kRidge : JunctionKind::kSmooth;
    options.bend_angle_degrees = i % 5 == 4 ? 25 : 0;
    options.displacement.amount = displacement;
    options.displacement.ridged = i % 4 < 2;
    shoot(random_skeleton(seed, internodes), options, 100 + seed, rays_a_tree, counts);
  }
  CHECK(counts.hits > counts.rays / 4);
  CHECK(counts.hits < counts.rays);
  CHECK(counts.found_only_by_bounds < counts.rays / 100);
  // Only rays that graze within the field's rounding.
  CHECK(counts.unequal <= counts.rays / 100000);
}

}  // namespace

TEST_CASE("random rays meet random trees where a dense march says") { shoot_at_trees(20, 500, 14); }

TEST_CASE("random rays meet displaced random trees where a dense march says") { shoot_at_trees(20, 300, 14, 0.4); }

TEST_CASE("half a million random rays meet displaced random trees where a dense march says", "[long]") {
  shoot_at_trees(50, 10000, 25, 0.4);
}

TEST_CASE("a million random rays meet random trees where a dense march says", "[long]") {
  shoot_at_trees(50, 20000, 25);
}
