// Sharp joints and confined blending: answers from the geometry of round cones.

#include <catch2/catch.hpp>

#include "blobtree/from_skeleton.h"
#include "blobtree/joint_plan.h"
#include "blobtree/primitive.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

double value(const Field& field, const Vec3& p) {
  double f = 0;
  field.values({&p, 1}, {&f, 1});
  return f;
}

// Distance from `origin` to where the solid ends along `direction`.
double surface_radius(const Field& field, const Vec3& origin, const Vec3& direction) {
  double inside = 0, outside = 0.05;
  while (value(field, origin + outside * direction) >= kIsoValue) inside = outside, outside += 0.05;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (inside + outside);
    (value(field, origin + middle * direction) >= kIsoValue ? inside : outside) = middle;
  }
  return inside;
}

// A unit axis that turns in the plane z = 0, by alternating angles.
Skeleton zigzag(double length, double turn_degrees, int count) {
  Skeleton skeleton;
  Vec3 base(0);
  for (int i = 0; i < count; ++i) {
    const double angle = i % 2 ? turn_degrees * kDegree : 0;
    const Vec3 tip = base + length * Vec3(std::sin(angle), std::cos(angle), 0);
    skeleton.internodes.push_back({base, tip, 1, 1, i - 1});
    base = tip;
  }
  return skeleton;
}

// Two laterals of a trunk, far from each other where they leave it, whose middles pass each other at `distance`.
Skeleton passing_twigs(double distance) {
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0, -10, 0), Vec3(0, 0, 0), 1, 1});
  skeleton.internodes.push_back({Vec3(0, 0, 0), Vec3(0, 20, 0), 1, 0.9, 0});
  skeleton.internodes.push_back({Vec3(0, 20, 0), Vec3(0, 30, 0), 0.9, 0.9, 1});
  skeleton.internodes.push_back({Vec3(0, 0, 0), Vec3(20, 20, 0), 0.4, 0.4, 0, 1});
  skeleton.internodes.push_back({Vec3(0, 20, 0), Vec3(20, 0, 2 * distance), 0.4, 0.4, 1, 1});
  return skeleton;
}

bool is_union_of_round_cones(const Skeleton& skeleton) {
  const auto field = compile(tree_from_skeleton(skeleton));
  Vec3 lowest = skeleton.internodes[0].base, highest = lowest;
  for (const Internode& a : skeleton.internodes) {
    lowest = glm::min(lowest, glm::min(a.base, a.tip) - 2.0);
    highest = glm::max(highest, glm::max(a.base, a.tip) + 2.0);
  }
  RandomSource random(7);
  int different = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = random.in_box({lowest, highest});
    double outside = 1e9;
    for (const Internode& a : skeleton.internodes) {
      const Sphere sphere = nearest_sphere(Cone{a.base, a.tip, a.base_radius, a.tip_radius}, p);
      outside = std::min(outside, glm::distance(sphere.center, p) - sphere.radius);
    }
    if (std::abs(outside) > 1e-4) different += (value(*field, p) >= kIsoValue) != (outside < 0);
  }
  return different == 0;
}

TreeOptions smooth(BlendingKind blending) {
  TreeOptions options;
  options.junction = JunctionKind::kSmooth;
  options.blending = blending;
  return options;
}

}  // namespace

TEST_CASE("an axis keeps its radius around the outside of a sharp turn and across its plane") {
  for (const double turn : {10.0, 30.0, 60.0, 90.0, 120.0}) {
    TreeOptions options;
    options.round_turn_degrees = 8;
    const auto field = compile(tree_from_skeleton(junction({{turn, 0, 1}}), options));
    const Vec3 elbow(-std::cos(turn / 2 * kDegree), std::sin(turn / 2 * kDegree), 0);
    CAPTURE(turn);
    // Nothing but the child's cap is there: the paper's shortening takes the parent out of reach.
    CHECK(surface_radius(*field, Vec3(0), elbow) == Approx(1).margin(1e-3));
    if (turn > 90) continue;  // a branch that turns back lies beside its parent, and blends with it
    const Vec3 branch(std::sin(turn * kDegree), std::cos(turn * kDegree), 0);
    for (int i = 0; i <= 80; ++i) {
      CHECK(surface_radius(*field, Vec3(0, -0.05 * i, 0), Vec3(0, 0, 1)) == Approx(1).margin(2.5e-3));
      CHECK(surface_radius(*field, 0.05 * i * branch, Vec3(0, 0, 1)) == Approx(1).margin(2.5e-3));
    }
  }
}

TEST_CASE("what has no room to fade is the union of its round cones") {
  const Skeleton short_zigzag = zigzag(0.5, 70, 12);
  CHECK(is_union_of_round_cones(short_zigzag));
  // A shortened internode would leave a gap to the next but one.
  Skeleton short_link = zigzag(6, 100, 3);
  const Vec3 link = 0.3 * glm::normalize(short_link.internodes[1].tip - short_link.internodes[1].base);
  short_link.internodes[1].tip = short_link.internodes[2].base = short_link.internodes[1].base + link;
  short_link.internodes[2].tip = link + Vec3(6, 6, 0);
  CHECK(is_union_of_round_cones(short_link));
  // Back beside the parent; thinner; as short tips and feet; into a cone.
  CHECK(is_union_of_round_cones(junction({{110, 0, 1}})));
  CHECK(is_union_of_round_cones(junction({{50, 0, 0.8}})));
  CHECK(is_union_of_round_cones(junction({{20, 0, 1}}, 0.8)));
  Skeleton cone = junction({{20, 0, 1}});
  cone.internodes[1].tip_radius = 0.2;
  CHECK(is_union_of_round_cones(cone));
  // And what has room is not.
  CHECK(!is_union_of_round_cones(junction({{50, 0, 1}})));
  CHECK(!is_union_of_round_cones(junction({{20, 0, 1}})));
}

TEST_CASE("a tapering axis keeps its radius across the plane of a sharp turn") {
  // As much wood at the joint as the taper says, on both sides of it.
  for (const double taper : {-1. / 80, -1. / 160, 1. / 160, 1. / 80}) {
    Skeleton skeleton = junction({{60, 0, 1}});
    skeleton.internodes[0].base_radius = 1 - 10 * taper;
    skeleton.internodes[1].tip_radius = 1 + 10 * taper;
    REQUIRE(plan_joints(skeleton, {}, child_table(skeleton), 30)[0].shortening > 0);
    const auto field = compile(tree_from_skeleton(skeleton));
    CAPTURE(taper);
    for (int i = 0; i <= 80; ++i) {
      const double y = -0.05 * i;
      CHECK(surface_radius(*field, Vec3(0, y, 0), Vec3(0, 0, 1)) == Approx(1 + taper * y).margin(6e-3));
    }
  }
}

TEST_CASE("tangents tell whether an axis turns, not chords") {
  // Two quarters of a circle: the chords turn by a right angle, the arcs not at all.
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0), Vec3(10, 10, 0), 1, 1});
  skeleton.internodes.push_back({Vec3(10, 10, 0), Vec3(20, 0, 0), 1, 1, 0});
  const Vec3 first = glm::normalize(Vec3(-1, 1, 0)), second = glm::normalize(Vec3(1, 1, 0));
  const std::vector<Arc> arcs{{first, 90}, {second, 90}};
  CHECK(plan_joints(skeleton, arcs, child_table(skeleton), 30)[0].fades_at_tip);
  CHECK(!plan_joints(skeleton, {}, child_table(skeleton), 30)[0].fades_at_tip);
}

TEST_CASE("gentle turns and symmetric forks fade") {
  // The leader of the last turns by 55 degrees, and all of it, with the other branch's cross-section, by 45.
  const Skeleton sympodium = junction({{55, 0, 0.9}, {15, 180, 0.45}});
  for (const Skeleton& skeleton : {zigzag(3, 25, 9), fork(2, 60), fork(5, 80), sympodium}) {
    const std::vector<JointPlan> plans = plan_joints(skeleton, {}, child_table(skeleton), 30);
    CHECK(plans[0].fades_at_tip);
    for (std::size_t i = 1; i < plans.size(); ++i) CHECK(plans[i].fades_at_base);
  }
}

TEST_CASE("a rounded corner is as thick as its axis, if not around it") {
  TreeOptions options;
  options.round_turn_degrees = 180;
  for (const double turn : {10.0, 30.0, 60.0, 90.0}) {
    const auto field = compile(tree_from_skeleton(junction({{turn, 0, 1}}), options));
    const Vec3 outwards(-std::cos(turn / 2 * kDegree), std::sin(turn / 2 * kDegree), 0);
    CAPTURE(turn);
    // In the bisecting plane both fields are equal and their weights sum to one across the plane of the turn.
    CHECK(surface_radius(*field, Vec3(0), Vec3(0, 0, 1)) == Approx(1).margin(1e-5));
    CHECK(surface_radius(*field, Vec3(0), outwards) < 0.96);
    CHECK(surface_radius(*field, Vec3(0), outwards) + surface_radius(*field, Vec3(0), -outwards) > 1.95);
  }
}

TEST_CASE("confined blending keeps twigs of different branches apart, which whole subtrees fuse") {
  // At 1.1 radii each from both axes the two fields sum to more than the iso-value, and neither reaches it.
  const Skeleton skeleton = passing_twigs(0.88);
  const Vec3 between(10, 10, 0.44);
  CHECK(value(*compile(tree_from_skeleton(skeleton, smooth(BlendingKind::kSubtrees))), between) > kIsoValue);
  CHECK(value(*compile(tree_from_skeleton(skeleton, smooth(BlendingKind::kConfined))), between) < kIsoValue);
}

TEST_CASE("confined blending is the sum of all at every junction of long internodes, and smooth in between") {
  const Skeleton skeleton = passing_twigs(8);
  const auto whole = compile(tree_from_skeleton(skeleton, smooth(BlendingKind::kSubtrees)));
  const auto confined = compile(tree_from_skeleton(skeleton, smooth(BlendingKind::kConfined)));
  const auto reference = reference_field(tree_from_skeleton(skeleton, smooth(BlendingKind::kConfined)));
  RandomSource random(3);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random.in_box({Vec3(-2, -12, -2), Vec3(6, 32, 4)});
    double f = 0, g = 0;
    Vec3 gradient, other;
    whole->values_and_gradients({&p, 1}, {&f, 1}, {&gradient, 1});
    confined->values_and_gradients({&p, 1}, {&g, 1}, {&other, 1});
    CHECK(g == Approx(f).margin(1e-5));
    CHECK(glm::distance(gradient, other) < 1e-4);
    CHECK(g == Approx(value(*reference, p)).margin(1e-5));
  }
}

TEST_CASE("confined blending takes one primitive an internode, whatever the depth") {
  Skeleton skeleton;
  const int length = 50'000;
  for (int i = 0; i < length; ++i) {
    const double angle = i % 2 ? 5 * kDegree : 0;
    const Vec3 base = i ? skeleton.internodes.back().tip : Vec3(0);
    skeleton.internodes.push_back({base, base + 5.0 * Vec3(std::sin(angle), std::cos(angle), 0), 1, 1, i - 1});
  }
  const auto field = compile(tree_from_skeleton(skeleton, smooth(BlendingKind::kConfined)));
  CHECK(field->primitive_count() == static_cast<std::size_t>(length));
  const Vec3 middle = 0.5 * (skeleton.internodes[1000].base + skeleton.internodes[1000].tip);
  CHECK(value(*field, middle) == Approx(1).margin(1e-5));
}
