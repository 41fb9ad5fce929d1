#include "blobtree/line_cones.h"

#include <catch2/catch.hpp>

#include "blobtree/cone_kernels.h"
#include "blobtree/from_skeleton.h"
#include "blobtree/primitive.h"
#include "tests/blobtree/instruction_sets.h"
#include "tests/blobtree/random_trees.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

std::vector<std::uint32_t> all_of(const FieldModel& model) {
  std::vector<std::uint32_t> all(model.cones.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

// F and |grad F| by all primitives.
FieldSample sample_at(const FieldModel& model, const FieldProgram& program, const Vec3& p) {
  FieldSample s{0, Vec3(0)};
  evaluate(model, program, {&p, 1}, {&s.value, 1}, {&s.gradient, 1});
  return s;
}

// Tapers from gentle to so steep that the limits of the radius are at work, free ends and faded ones.
BlobTree random_cones(RandomSource& random, int count) {
  BlobTree tree;
  std::vector<NodeId> children;
  const auto radius = [&] { return random.uniform(0.05, 0.5); };
  for (int i = 0; i < count; ++i) {
    const Vec3 base = random.in_box({Vec3(-1), Vec3(1)}), tip = base + random.uniform(0.1, 1.5) * random.direction();
    const double r0 = radius(), r1 = random.chance(0.6) ? r0 * random.uniform(0.8, 1.1) : radius();
    if (random.chance(0.5)) {
      children.push_back(tree.add(Cone{base, tip, r0, r1}));
    } else {
      const double parent = random.chance(0.6) ? radius() : 0, child = random.chance(0.6) ? radius() : 0;
      children.push_back(tree.add(FadedCone{base, tip, r0, r1, parent, child}));
    }
  }
  tree.add(Sum{}, std::move(children));
  return tree;
}

struct Tally {
  int rays = 0, met = 0, unmet = 0, steady = 0, bounded = 0, left_out = 0;
};

// Rays that start and go nearly as one does.
RayBundle neighbours_of(const Ray& ray, const Interval& range, RandomSource& random) {
  RayBundle bundle(ray, range);
  const auto count = static_cast<std::size_t>(random.integer(1, RayBundle::kWidth));
  const double spread = std::pow(10.0, random.uniform(-4, -1));
  while (bundle.count < count) {
    const Vec3 direction = glm::normalize(ray.direction + spread * random.direction());
    bundle.add({ray.origin + spread * random.direction(), direction},
               {range.lo, range.lo + random.uniform(0.5, 1) * (range.hi - range.lo)});
  }
  return bundle;
}

// Everything that a meeting says of pieces of rays, at points of them.
void check_meeting(const FieldModel& model, const Ray& first, const Interval& first_range, RandomSource& random,
                   Tally& tally) {
  const std::vector<std::uint32_t> all = all_of(model);
  FieldProgram whole, met, rest;
  assemble(model, all, whole);
  const RayBundle bundle = neighbours_of(first, first_range, random);
  const RayLanes asked = random.chance(0.5) ? bundle.lanes() : 1;
  LineMeeting meeting;
  meet(model, all, bundle, asked, bundle.ranges, meeting);
  REQUIRE((meeting.rays & ~asked) == 0);
  const auto point = [&](const Interval& in) { return random.uniform(in.lo, in.hi); };
  const auto value = [&](const FieldProgram& program, const Ray& ray, double t) {
    return sample_at(model, program, ray.at(t)).value;
  };
  for_each_lane(asked & ~meeting.rays, [&](std::size_t lane) {
    ++tally.left_out;
    const double most = model.is_below_sum ? kIsoValue : 0;
    for (int k = 0; k < 12; ++k) REQUIRE(value(whole, bundle.ray(lane), point(bundle.ranges[lane])) <= most + 1e-5);
  });
  if (meeting.rays == 0) return;
  ++tally.rays;
  tally.met += static_cast<int>(meeting.primitives.size());
  tally.unmet += static_cast<int>(all.size() - meeting.primitives.size());
  for (const ConeBounds& bounds : meeting.cones) tally.steady += bounds.steady;
  assemble(model, meeting.primitives, met);
  const FieldBounds bounds = bound_along(model, met, meeting, bundle, rest);
  tally.bounded += std::isfinite(bounds.second.lo);
  for_each_lane(meeting.rays, [&](std::size_t lane) {
    const Ray ray = bundle.ray(lane);
    const Interval range = bundle.ranges[lane], reach = meeting.reach[lane];
    REQUIRE((range.contains(reach.lo) && range.contains(reach.hi)));
    for (int k = 0; k < 12; ++k) {
      const double t = k % 2 ? point(range) : point(reach);
      const FieldSample expected = sample_at(model, whole, ray.at(t));
      CAPTURE(lane, t, range.lo, range.hi, reach.lo, reach.hi, expected.value);
      REQUIRE(value(met, ray, t) == expected.value);
      if (!reach.contains(t)) {
        REQUIRE(expected.value <= 1e-5);
        continue;
      }
      REQUIRE(std::abs(value(rest, ray, t) - expected.value) <= 1e-6);
      REQUIRE(expected.value <= bounds.value.hi + 1e-5);
      REQUIRE(expected.value >= bounds.value.lo - 1e-5);
      REQUIRE(glm::length(expected.gradient) <= bounds.slope * (1 + 1e-4) + 1e-4);
      const double a = point(reach), b = point(reach), h = b - a, between = a + random.uniform(0, 1) * h;
      const double at_a = value(whole, ray, a), at_b = value(whole, ray, b), inside = value(whole, ray, between);
      const double kinked = bounds.kink * std::abs(h) / 4;
      REQUIRE(inside <= std::max(at_a, at_b) - bounds.second.lo * h * h / 8 + kinked + 1e-5);
      REQUIRE(inside >= std::min(at_a, at_b) - bounds.second.hi * h * h / 8 - kinked - 1e-5);
    }
  });
}

Ray random_ray(const BlobTree& tree, RandomSource& random) {
  const Vec3 origin = random.in_box({Vec3(-2), Vec3(2)});
  // Some run along a cone's axis, and some graze a plain cone lengthwise, to leave its support past its thick end.
  const Node& node = tree.nodes[static_cast<std::size_t>(random.integer(0, static_cast<int>(tree.nodes.size()) - 1))];
  const FadedCone* faded = std::get_if<FadedCone>(&node.what);
  if (faded && random.chance(0.1)) return {origin, glm::normalize(faded->tip - faded->base)};
  const Cone* plain = std::get_if<Cone>(&node.what);
  if (plain && plain->base != plain->tip && random.chance(0.3)) {
    const Vec3 axis = glm::normalize(plain->tip - plain->base), side = glm::cross(axis, random.direction());
    const double thick = std::max(plain->base_radius, plain->tip_radius);
    const Vec3 target = plain->tip + random.uniform(1.8, 2.1) * thick * glm::normalize(side);
    const Vec3 direction = glm::normalize(axis + random.uniform(-0.1, 0.1) * random.direction());
    return {target - 1.5 * direction, direction};
  }
  return {origin, random.direction()};
}

Interval random_range(RandomSource& random) {
  const double start = random.uniform(-2, 1);
  return {start, start + std::pow(10.0, random.uniform(-2, 0.5))};
}

}  // namespace

TEST_CASE("what a ray meets of cones bounds them along it, on every instruction set") {
  const int sets = on_every_instruction_set([] {
    Tally tally;
    RandomSource random(61);
    for (int i = 0; i < 600; ++i) {
      const BlobTree tree = random_cones(random, 1 + i % 20);
      const auto model = compile_model(tree);
      for (int k = 0; k < 6; ++k) {
        CAPTURE(i, k);
        check_meeting(*model, random_ray(tree, random), random_range(random), random, tally);
      }
    }
    CHECK(tally.unmet > tally.met);
    CHECK(tally.steady > tally.met / 20);
    CHECK(tally.bounded > tally.rays / 6);
    CHECK(tally.left_out > 100);
  });
  CHECK(sets >= 2);
}

TEST_CASE("what a ray meets of trees of every kind of node bounds them along it") {
  Tally tally;
  for (int seed = 0; seed < 300; ++seed) {
    const BlobTree tree = random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 30);
    const auto model = compile_model(tree);
    RandomSource random(7000 + static_cast<std::uint64_t>(seed));
    for (int k = 0; k < 12; ++k) {
      CAPTURE(seed, k);
      check_meeting(*model, random_ray(tree, random), random_range(random), random, tally);
    }
  }
}

TEST_CASE("what a ray meets of bent and ridged trees bounds them along it") {
  Tally tally;
  for (int seed = 0; seed < 60; ++seed) {
    TreeOptions options;
    options.junction = seed % 3 ? JunctionKind::kRidge : JunctionKind::kSmooth;
    options.bend_angle_degrees = seed % 2 ? 30 : 0;
    const BlobTree tree = tree_from_skeleton(random_skeleton(static_cast<std::uint64_t>(seed), 2 + seed % 12), options);
    const auto model = compile_model(tree);
    const Box around = model->support;
    RandomSource random(7500 + static_cast<std::uint64_t>(seed));
    for (int k = 0; k < 60; ++k) {
      const Ray ray{random.in_box(around), random.direction()};
      const double length = random.uniform(0, 0.3) * around.diagonal();
      CAPTURE(seed, k);
      check_meeting(*model, ray, {0, length}, random, tally);
    }
  }
  CHECK(tally.unmet > tally.met);
  CHECK(tally.left_out > 100);
}

TEST_CASE("cones at points of a line agree with their formulas to 1e-5, on every instruction set") {
  on_every_instruction_set([] {
    RandomSource random(63);
    for (int i = 0; i < 2000; ++i) {
      const BlobTree tree = random_cones(random, 1);
      const Node& node = tree.nodes.front();
      const Ray ray{random.in_box({Vec3(-1), Vec3(1)}), random.direction()};
      const auto* faded = std::get_if<FadedCone>(&node.what);
      const ConeRecord record = faded ? record_of(*faded, 1) : record_of(std::get<Cone>(node.what), 1);
      const LineCone cone =
          line_cone(record, faded ? kind_of_faded(record) : ConeKind::kPlain, ray.origin, ray.direction, 1, 1.5);
      std::array<float, kBatchGranule> t, f;
      for (float& x : t) x = static_cast<float>(random.uniform(-1.5, 1.5));
      sum_cones_along({&cone, 1}, t.data(), f.data());
      for (std::size_t k = 0; k < t.size(); ++k) {
        const Vec3 p = ray.at(t[k]);
        const double expected = faded ? sample(*faded, p).value : sample(std::get<Cone>(node.what), p).value;
        CAPTURE(i, k, t[k]);
        REQUIRE(std::abs(f[k] - expected) <= 2e-5);
      }
    }
  });
}
