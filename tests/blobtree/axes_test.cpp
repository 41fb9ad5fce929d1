#include "blobtree/axes.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "blobtree/falloff.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

TreeOptions bent(double angle_degrees) {
  TreeOptions options;
  options.bend_angle_degrees = angle_degrees;
  return options;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

// The largest jump of the tangent where one internode alone continues another.
double largest_jump(const Axes& axes) {
  const ChildTable table = child_table(axes.skeleton);
  double largest = 0;
  for (std::size_t i = 0; i < axes.arcs.size(); ++i) {
    const Internode& a = axes.skeleton.internodes[i];
    if (a.parent == kNoInternode) continue;
    const auto parent = static_cast<std::size_t>(a.parent);
    if (table.first[parent + 1] - table.first[parent] != 1) continue;
    largest = std::max(largest, angle_between(end_tangent(axes.skeleton.internodes[parent], axes.arcs[parent]),
                                              start_tangent(a, axes.arcs[i])));
  }
  return largest;
}

// A thin chain of internodes of random lengths and directions, each turned by up to 50 degrees.
Skeleton crooked_chain(std::uint64_t seed, int count) {
  RandomSource random(seed);
  Skeleton skeleton;
  Vec3 at(0), direction(0, 1, 0);
  for (int i = 0; i < count; ++i) {
    const Vec3 side = glm::normalize(glm::cross(direction, random.direction()));
    const double turn = random.uniform(0, 50) * kDegree;
    direction = std::cos(turn) * direction + std::sin(turn) * side;
    const Vec3 tip = at + random.uniform(1, 3) * direction;
    skeleton.internodes.push_back({at, tip, 0.02, 0.02, static_cast<InternodeId>(i) - 1});
    at = tip;
  }
  return skeleton;
}

}  // namespace

// By how much a tangent may jump where an arc is so flat that it is straight: half of what an arc of 30 000 radii
// turns.
constexpr double kMostJump = 0.5 * 3 / (3e4 * 0.02);

TEST_CASE("bent chains keep their tangents continuous and their nodes in place") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Skeleton skeleton = crooked_chain(seed, 20);
    const Axes axes = axes_of(skeleton, bent(30));
    CAPTURE(seed);
    CHECK(largest_jump(axes) < kMostJump);
    // Every node of the skeleton is still one, and every axis ends where the next begins.
    std::size_t found = 0;
    for (const Internode& a : axes.skeleton.internodes) {
      found += found < 20 && a.tip == skeleton.internodes[found].tip;
      if (a.parent != kNoInternode) CHECK(axes.skeleton.internodes[static_cast<std::size_t>(a.parent)].tip == a.base);
    }
    CHECK(found == 20);
  }
}

TEST_CASE("a chain that is not all bent is tangent to its straight internodes") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TreeOptions options;
    options.bends.push_back({{}, 25});
    options.bends[0].internodes.fraction = 0.6;
    options.bends[0].internodes.seed = static_cast<std::int64_t>(seed);
    const Axes axes = axes_of(crooked_chain(seed, 2), options);
    const Selection& drawn = options.bends[0].internodes;
    const Skeleton skeleton = crooked_chain(seed, 2);
    const Selector selector(skeleton, drawn);
    if (selector.selects(0) || selector.selects(1)) CHECK(largest_jump(axes) < kMostJump);
  }
}

TEST_CASE("a chain inscribed in a circle becomes that circle") {
  Skeleton skeleton;
  const double steps[] = {10, 25, 14, 31, 20};
  double angle = 0;
  Vec3 at(4, 0, 0);
  for (int i = 0; i < 5; ++i) {
    angle += steps[i] * kDegree;
    const Vec3 tip = 4.0 * Vec3(std::cos(angle), std::sin(angle), 0);
    skeleton.internodes.push_back({at, tip, 0.05, 0.05, i - 1});
    at = tip;
  }
  const Axes axes = axes_of(skeleton, bent(10));
  for (std::size_t i = 0; i < axes.arcs.size(); ++i) {
    for (const double share : {0.1, 0.5, 0.8}) {
      CHECK(glm::length(point_on(axes.skeleton.internodes[i], axes.arcs[i], share)) == Approx(4).epsilon(1e-6));
    }
  }
}

TEST_CASE("a lateral leaves by half its angle farther from its parent and ends where it did") {
  const Axes axes = axes_of(junction({{0, 0, 0.8}, {50, 0, 0.3}}), bent(40));
  REQUIRE(axes.arcs.size() == 3);
  CHECK(axes.arcs[1].angle_degrees == 0);
  const Internode& lateral = axes.skeleton.internodes[2];
  CHECK(angle_between(start_tangent(lateral, axes.arcs[2]), Vec3(0, 1, 0)) / kDegree == Approx(70));
  CHECK(angle_between(end_tangent(lateral, axes.arcs[2]), Vec3(0, 1, 0)) / kDegree == Approx(30));
}

TEST_CASE("the last bend rule for an internode counts") {
  TreeOptions options = bent(40);
  options.bends.resize(2);
  options.bends[0].internodes.order = {1, 1};
  options.bends[0].angle_degrees = 10;
  options.bends[1].internodes.radius = {0, 0.35};
  options.bends[1].angle_degrees = 24;
  Skeleton skeleton = junction({{0, 0, 0.8}, {50, 0, 0.3}, {60, 120, 0.5}});
  skeleton.internodes[2].order = skeleton.internodes[3].order = 1;
  const Axes axes = axes_of(skeleton, options);
  CHECK(axes.arcs[2].angle_degrees == Approx(24));
  CHECK(axes.arcs[3].angle_degrees == Approx(10));
}

TEST_CASE("a bent chain's surface keeps its radius around the axis") {
  Skeleton skeleton;
  for (int i = 0; i < 4; ++i) {
    const auto at = [](int k) { return 20.0 * Vec3(std::cos(k * 20 * kDegree), std::sin(k * 20 * kDegree), 0); };
    skeleton.internodes.push_back({at(i), at(i + 1), 1, 1, i - 1});
  }
  const auto field = reference_field(tree_from_skeleton(skeleton, bent(10)));
  for (double degrees = 5; degrees < 75; degrees += 0.7) {
    const Vec3 outward(std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0);
    for (const Vec3& side : {outward, -outward, Vec3(0, 0, 1)}) {
      double inside = 0, outside = 1.9;
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (inside + outside);
        const Vec3 p = 20.0 * outward + middle * side;
        double value = 0;
        field->values({&p, 1}, {&value, 1});
        (value >= kIsoValue ? inside : outside) = middle;
      }
      CAPTURE(degrees);
      CHECK(inside == Approx(1).margin(0.011));
    }
  }
}

TEST_CASE("points end in their radius, buds are widest where they should be") {
  const auto radius_at = [](const Field& field, double y) {
    double inside = 0, outside = 1.9;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (inside + outside);
      const Vec3 p(middle, y, 0);
      double value = 0;
      field.values({&p, 1}, {&value, 1});
      (value >= kIsoValue ? inside : outside) = middle;
    }
    return inside;
  };
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0, -10, 0), Vec3(0), 1, 1});
  TreeOptions options;
  options.tips.resize(1);
  options.tips[0].length = 12;
  const auto pointed = reference_field(tree_from_skeleton(skeleton, options));
  // Away from both ends it is the cone: across the axis 1 / sqrt(1 - s^2) times the radius.
  const double taper = (1 - kPointRadius) / 12;
  for (const double y : {4.0, 6.0, 9.0, 11.0}) {
    CHECK(radius_at(*pointed, y) == Approx((1 - taper * y) / std::sqrt(1 - taper * taper)).epsilon(0.02));
  }
  CHECK(radius_at(*pointed, -5) == Approx(1).epsilon(1e-3));
  CHECK(radius_at(*pointed, 12 + 0.9 * kPointRadius) > 0);
  CHECK(radius_at(*pointed, 12 + 1.1 * kPointRadius) < 1e-6);

  options.tips[0].kind = TipKind::kBud;
  const auto bud = reference_field(tree_from_skeleton(skeleton, options));
  double widest = 0, at = 0;
  for (double y = 0; y < 12; y += 0.1) {
    if (const double r = radius_at(*bud, y); r > widest) widest = r, at = y;
  }
  CHECK(widest == Approx(kBudRadius).epsilon(0.05));
  CHECK(at == Approx(12 * kBudWidest).margin(1));
  options.tips[0].kind = TipKind::kRound;
  CHECK(tree_from_skeleton(skeleton, options) == tree_from_skeleton(skeleton));
}

TEST_CASE("bends and tips out of range are refused") {
  TreeOptions options;
  options.bends.push_back({{}, 180});
  CHECK_THROWS_AS(tree_from_skeleton(chain(1, 3, 0), options), InputError);
  options = {};
  options.tips.push_back({{}, TipKind::kPointed, 0.5});
  CHECK_THROWS_AS(tree_from_skeleton(chain(1, 3, 0), options), InputError);
}
