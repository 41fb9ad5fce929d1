// The acceptance figures of docs/field.md, "Joints": radii of the surface around axes of unit radius.

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "blobtree/falloff.h"
#include "blobtree/from_skeleton.h"
#include "tests/support/skeletons.h"
#include "tests/support/surface_measures.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

std::shared_ptr<const Field> field_of(const Skeleton& skeleton, JointKind joint, JunctionKind junction) {
  TreeOptions options;
  options.joint = joint;
  options.junction = junction;
  return compile(tree_from_skeleton(skeleton, options));
}

double value(const Field& field, const Vec3& p) {
  double f = 0;
  field.values({&p, 1}, {&f, 1});
  return f;
}

Vec3 around(double azimuth_degrees) {
  return {std::cos(azimuth_degrees * kDegree), 0, std::sin(azimuth_degrees * kDegree)};
}

// No branch is wider.
constexpr double kFarthest = 1.9;

struct Profile {
  double lowest = 10, highest = 0;
  double rise_after_dip = 0;
  void add(double radius) {
    lowest = std::min(lowest, radius);
    highest = std::max(highest, radius);
    rise_after_dip = std::max(rise_after_dip, radius - lowest);
  }
};
Profile along_trunk(const Field& field, double from, double to, double azimuth_degrees) {
  Profile profile;
  for (int i = 0; i <= 200; ++i) {
    profile.add(surface_radius(field, Vec3(0, from + (to - from) * i / 200, 0), around(azimuth_degrees), kFarthest));
  }
  return profile;
}

}  // namespace

TEST_CASE("the paper's straight and turned continuations keep their radius") {
  for (const double turn : {0.0, 30.0, 60.0, 90.0}) {
    const auto field = field_of(junction({{turn, 0, 1}}), JointKind::kPaper, JunctionKind::kRidge);
    Profile out_of_plane;
    for (int i = 0; i <= 80; ++i) {
      out_of_plane.add(surface_radius(*field, Vec3(0, -0.05 * i, 0), Vec3(0, 0, 1), kFarthest));
      const Vec3 on_branch = 0.05 * i * Vec3(std::sin(turn * kDegree), std::cos(turn * kDegree), 0);
      out_of_plane.add(surface_radius(*field, on_branch, Vec3(0, 0, 1), kFarthest));
    }
    CAPTURE(turn);
    CHECK(out_of_plane.lowest >= 0.9975);
    CHECK(out_of_plane.highest <= 1.0025);
    const Vec3 elbow(-std::cos(turn / 2 * kDegree), std::sin(turn / 2 * kDegree), 0);
    CHECK(surface_radius(*field, Vec3(0), elbow, kFarthest) == Approx(1.0).margin(5e-4));
  }
}

TEST_CASE("the paper's ridged forks do not bulge between the branches") {
  for (const double angle : {20.0, 35.0, 50.0}) {
    const auto field = field_of(fork(2, angle), JointKind::kPaper, JunctionKind::kRidge);
    CHECK(along_trunk(*field, -6, 0, 90).highest <= 1.0005);
  }
  for (const double r : {0.3, 0.5, 0.7}) {
    const auto field =
        field_of(junction({{0, 0, std::sqrt(1 - r * r)}, {50, 0, r}}), JointKind::kPaper, JunctionKind::kRidge);
    CHECK(along_trunk(*field, -6, 0, 90).highest <= 1.0005);
    CHECK(along_trunk(*field, -6, 0, 180).highest <= 1.0005);
  }
}

TEST_CASE("the paper's forks of many branches neck as computed, smooth ones more") {
  const double ridged[] = {0.975, 0.981, 0.984, 0.992}, smooth[] = {0.929, 0.888, 0.855, 0.839};
  for (int count = 3; count <= 6; ++count) {
    const double between = 180.0 / count;
    const Profile ridge =
        along_trunk(*field_of(fork(count, 40), JointKind::kPaper, JunctionKind::kRidge), -6, 0, between);
    const Profile sum =
        along_trunk(*field_of(fork(count, 40), JointKind::kPaper, JunctionKind::kSmooth), -6, -0.1, between);
    CAPTURE(count);
    CHECK(ridge.lowest == Approx(ridged[count - 3]).margin(4e-3));
    CHECK(ridge.highest <= 1.0005);
    CHECK(sum.lowest == Approx(smooth[count - 3]).margin(2e-3));
    CHECK(sum.highest <= 1.0005);
  }
}

TEST_CASE("faded joints along an axis leave no trace, whatever the internodes' length and taper") {
  for (const double length : {0.2, 0.5, 1.0, 2.0, 4.0, 8.0}) {
    for (const double taper : {0.0, 0.01}) {
      const auto field = field_of(chain(length, 48, taper), JointKind::kFaded, JunctionKind::kRidge);
      for (double y = 10; y < 20; y += 0.0517) {
        // Across the axis a cone of slope s has 1 / sqrt(1 - s^2) times the radius of its sphere there.
        const double expected = (1 - taper * y) / std::sqrt(1 - taper * taper);
        CAPTURE(length, taper, y);
        REQUIRE(surface_radius(*field, Vec3(0, y, 0), Vec3(1, 0, 0), kFarthest) == Approx(expected).epsilon(5e-6));
      }
    }
  }
}

TEST_CASE("faded forks neither neck nor ring below the fork") {
  for (int count = 2; count <= 6; ++count) {
    const double between = 180.0 / count;
    const Profile ridge =
        along_trunk(*field_of(fork(count, 32), JointKind::kFaded, JunctionKind::kRidge), -3.5, -0.1, between);
    const Profile sum =
        along_trunk(*field_of(fork(count, 32), JointKind::kFaded, JunctionKind::kSmooth), -3.5, -0.1, between);
    CAPTURE(count);
    CHECK(ridge.lowest >= 0.991);
    CHECK(ridge.highest <= 1.0035);
    CHECK(ridge.rise_after_dip <= 0.0035);
    CHECK(sum.lowest >= 0.998);
    CHECK(sum.highest <= 1.0065);
    CHECK(sum.rise_after_dip <= 0.0065);
  }
}

TEST_CASE("a bark ridge is a crease where branches touch, and smooth junctions have none") {
  // In the plane between two equal branches the ridge's gradients are mirror images; across it the normal turns
  // sharply.
  const auto turn_across = [](JunctionKind kind) {
    const auto field = field_of(fork(2, 35), JointKind::kFaded, kind);
    // The surface's point in the plane of symmetry, above the fork.
    const double height = [&] {
      double inside = 0, outside = 3;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (inside + outside);
        (value(*field, Vec3(0, middle, 0)) >= kIsoValue ? inside : outside) = middle;
      }
      return inside;
    }();
    double f = 0;
    Vec3 left, right;
    const Vec3 a(-1e-6, height, 0.02), b(1e-6, height, 0.02);
    field->values_and_gradients({&a, 1}, {&f, 1}, {&left, 1});
    field->values_and_gradients({&b, 1}, {&f, 1}, {&right, 1});
    return std::acos(std::clamp(glm::dot(glm::normalize(left), glm::normalize(right)), -1.0, 1.0)) / kDegree;
  };
  CHECK(turn_across(JunctionKind::kRidge) > 60);
  CHECK(turn_across(JunctionKind::kSmooth) < 1);
}

TEST_CASE("the order of the children at a fork does not matter") {
  Skeleton skeleton = junction({{10, 0, 0.8}, {50, 90, 0.4}, {60, 200, 0.45}});
  const auto one = field_of(skeleton, JointKind::kFaded, JunctionKind::kRidge);
  std::rotate(skeleton.internodes.begin() + 1, skeleton.internodes.begin() + 2, skeleton.internodes.end());
  const auto other = field_of(skeleton, JointKind::kFaded, JunctionKind::kRidge);
  RandomSource random(5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.in_box({Vec3(-2), Vec3(2)});
    CHECK(value(*one, p) == Approx(value(*other, p)).margin(1e-14));
  }
}

TEST_CASE("a bent internode leaves the rest of the tree where it is") {
  const Skeleton skeleton = junction({{0, 0, 0.8}, {50, 0, 0.5}});
  TreeOptions options;
  const auto straight = compile(tree_from_skeleton(skeleton, options));
  options.bend_angle_degrees = 30;
  const auto bent = compile(tree_from_skeleton(skeleton, options));
  // The collinear continuation and the trunk are as they were; the lateral bulges away from the trunk's axis.
  CHECK(value(*bent, Vec3(0, 8, 0)) == value(*straight, Vec3(0, 8, 0)));
  CHECK(value(*bent, Vec3(0.7, -6, 0.3)) == value(*straight, Vec3(0.7, -6, 0.3)));
  const Vec3 axis(std::sin(50 * kDegree), std::cos(50 * kDegree), 0),
      outward(std::cos(50 * kDegree), -std::sin(50 * kDegree), 0);
  const double sagitta = 10 / (2 * std::sin(15 * kDegree)) * (1 - std::cos(15 * kDegree));
  CHECK(value(*bent, 5.0 * axis + sagitta * outward) == Approx(1).margin(1e-6));
  // The chord's middle is now one sagitta away from the axis, whose influence reaches to 1.
  CHECK(value(*bent, 5.0 * axis) == Approx(falloff(sagitta * sagitta)).margin(1e-6));
  CHECK(value(*bent, 10.0 * axis) == Approx(value(*straight, 10.0 * axis)).margin(1e-6));
}

TEST_CASE("plants rooted apart do not blend, stems from one stool do") {
  Skeleton apart;
  apart.internodes.push_back({Vec3(0), Vec3(0, 5, 0), 1, 1});
  apart.internodes.push_back({Vec3(2.2, 0, 0), Vec3(2.2, 5, 0), 1, 1});
  const auto two = field_of(apart, JointKind::kFaded, JunctionKind::kSmooth);
  CHECK(value(*two, Vec3(1.1, 2.5, 0)) < kIsoValue);
  Skeleton stool;
  stool.internodes.push_back({Vec3(0), Vec3(-1.1, 5, 0), 1, 1});
  stool.internodes.push_back({Vec3(0), Vec3(1.1, 5, 0), 1, 1});
  const auto one = field_of(stool, JointKind::kFaded, JunctionKind::kSmooth);
  CHECK(value(*one, Vec3(0, 5, 0)) > kIsoValue);
}

TEST_CASE("an empty skeleton is the zero field, and settings out of range are refused") {
  CHECK(tree_from_skeleton({}).nodes.empty());
  TreeOptions options;
  options.bend_angle_degrees = 200;
  CHECK_THROWS_AS(tree_from_skeleton(chain(1, 3, 0), options), InputError);
  options = {};
  options.contact.width = 0.7;
  CHECK_THROWS_AS(tree_from_skeleton(chain(1, 3, 0), options), InputError);
}

TEST_CASE("an axis of a hundred thousand internodes with laterals compiles and evaluates") {
  Skeleton skeleton;
  InternodeId parent = kNoInternode;
  const int length = 100'000;
  for (int i = 0; i < length; ++i) {
    const auto id = static_cast<InternodeId>(skeleton.internodes.size());
    skeleton.internodes.push_back({Vec3(0, i, 0), Vec3(0, i + 1, 0), 0.4, 0.4, parent});
    if (i > 0) skeleton.internodes.push_back({Vec3(0, i, 0), Vec3(1, i + 1, 0), 0.1, 0.1, parent, 1});
    parent = id;
  }
  const BlobTree tree = tree_from_skeleton(skeleton);
  CHECK(depth(tree) > 100'000);
  const auto fast = compile(tree), slow = reference_field(tree);
  for (const double y : {0.5, 50000.3, 99999.7}) {
    const Vec3 p(0.35, y, 0.1);
    CHECK(value(*fast, p) == Approx(value(*slow, p)).margin(1e-5));
  }
}
