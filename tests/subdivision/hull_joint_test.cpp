#include "subdivision/hull_joint.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "subdivision/hull_trim.h"
#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

constexpr double kPi = std::numbers::pi;

// The solid angle of a triangle seen from the origin. [van Oosterom, Strackee 1983]
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(glm::dot(a, glm::cross(b, c)), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

std::vector<HullRing> rings_of(const std::vector<HullBranch>& branches) {
  std::vector<HullRing> rings;
  const std::vector<HullCone> cones = hull_cones(branches);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    HullRing ring{branches[i].direction, {}, {}, cones[i].angle, cones[i].gap};
    complete_frame(ring.axis, ring.side, ring.forward);
    rings.push_back(ring);
  }
  return rings;
}

// Triangles and rings' polygons together cover the sphere once.
void check_cover(const std::vector<HullBranch>& branches, int count) {
  const std::vector<HullRing> rings = rings_of(branches);
  const HullJoint joint = hull_joint(rings, count);
  std::vector<Vec3> points;
  double covered = 0;
  for (const HullRing& ring : rings) {
    for (int j = 0; j < count; ++j) {
      points.push_back(ring_direction(ring, j, count));
      covered += solid_angle(ring.axis, points.back(), ring_direction(ring, j + 1, count));
    }
  }
  for (const Vec3& extra : joint.extra) points.push_back(glm::normalize(extra));
  for (const auto& [a, b, c] : joint.triangles) {
    const double angle = solid_angle(points[a], points[b], points[c]);
    CHECK(angle > 0);
    covered += angle;
  }
  CHECK(covered == Approx(4 * kPi).epsilon(1e-9));
  // Euler: a triangulated sphere of v vertices has 2 v - 4 triangles, and a polygon of n corners stands for n - 2.
  CHECK(joint.triangles.size() == 2 * points.size() - 4 - rings.size() * static_cast<std::size_t>(count - 2));
}

}  // namespace

TEST_CASE("cones about branches are apart, whatever the branches") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomSource random(seed);
    std::vector<HullBranch> branches(static_cast<std::size_t>(random.integer(2, 12)));
    for (HullBranch& branch : branches) {
      branch = {random.direction(), std::exp(random.uniform(-6, 0)), std::exp(random.uniform(-3, 3))};
    }
    const std::vector<HullCone> cones = hull_cones(branches);
    for (std::size_t i = 0; i < branches.size(); ++i) {
      REQUIRE(cones[i].angle > 0);
      REQUIRE(cones[i].angle <= kWidestHullCone);
      for (std::size_t j = 0; j < i; ++j) {
        const double between = std::acos(glm::dot(branches[i].direction, branches[j].direction));
        REQUIRE(cones[i].angle + cones[j].angle < between);
      }
    }
  }
}

TEST_CASE("a branch leaves its cone beyond where the cylinders touch") {
  // d = (r2 + r1 cos t) / sin t along the first of two branches of radii r1 and r2. [Mac04, equation 5.1]
  for (const double degrees : {30.0, 60.0, 90.0, 110.0}) {
    for (const double r2 : {0.5, 0.8, 1.0}) {
      const double t = degrees * kPi / 180, r1 = 0.7;
      const std::vector<HullCone> cones =
          hull_cones(std::vector<HullBranch>{{Vec3(0, 1, 0), r1, 100}, {Vec3(std::sin(t), std::cos(t), 0), r2, 100}});
      CHECK(r1 / std::tan(cones[0].angle) > (r2 + r1 * std::cos(t)) / std::sin(t));
      CHECK(r2 / std::tan(cones[1].angle) > (r1 + r2 * std::cos(t)) / std::sin(t));
    }
  }
}

TEST_CASE("a short branch gets the angle that a long one can spare") {
  const Vec3 up(0, 1, 0), side(1, 0, 0);
  const double equal = hull_cones(std::vector<HullBranch>{{up, 1, 9}, {side, 1, 9}})[0].angle;
  const double wanting = hull_cones(std::vector<HullBranch>{{up, 1, 0.8}, {side, 1, 9}})[0].angle;
  CHECK(wanting > equal);
  CHECK(1 / std::tan(wanting) <= 0.8);
}

TEST_CASE("branches in one direction have no cones") {
  const std::vector<HullCone> cones = hull_cones(std::vector<HullBranch>{{Vec3(0, 1, 0)}, {Vec3(0, 1, 0)}});
  CHECK(cones[0].angle == 0);
  CHECK(cones[1].angle == 0);
}

TEST_CASE("joints and rings cover the sphere once: random branches") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    RandomSource random(seed);
    std::vector<HullBranch> branches(static_cast<std::size_t>(random.integer(2, 12)));
    for (HullBranch& branch : branches) branch = {random.direction(), std::exp(random.uniform(-4, 0)), 100};
    check_cover(branches, random.integer(3, 9));
  }
}

TEST_CASE("joints and rings cover the sphere once: symmetric branches, many vertices in one plane") {
  const std::vector<Vec3> axes = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::size_t count = 2; count <= axes.size(); ++count) {
    std::vector<HullBranch> branches;
    for (std::size_t i = 0; i < count; ++i) branches.push_back({axes[i], 0.5, 10});
    for (const int vertices : {3, 4, 6, 8}) check_cover(branches, vertices);
  }
  for (const int count : {5, 8, 16, 40}) {
    std::vector<HullBranch> branches = {{Vec3(0, -1, 0), 1, 10}, {Vec3(0, 1, 0), 1, 10}};
    for (int i = 0; i < count; ++i) {
      branches.push_back({Vec3(std::cos(2 * kPi * i / count), 0, std::sin(2 * kPi * i / count)), 0.1, 10});
    }
    check_cover(branches, 4);
  }
}

TEST_CASE("branches that leave to one side get vertices on the other") {
  const std::vector<HullRing> rings = rings_of({{glm::normalize(Vec3(1, 5, 0)), 0.1, 9}, {Vec3(0, 1, 0), 0.1, 9}});
  CHECK(hull_joint(rings, 4).extra.size() >= 2);
  check_cover({{glm::normalize(Vec3(1, 5, 0)), 0.1, 9}, {Vec3(0, 1, 0), 0.1, 9}}, 4);
}

TEST_CASE("a joint keeps near to its branches where some leave it far out and others near") {
  // Two branches in nearly one direction leave far out, two others at once; the ring's middle is `distance` away.
  std::vector<HullBranch> branches = {{Vec3(0, -1, 0), 1, 100}, {Vec3(1, 0, 0), 0.5, 100}, {Vec3(0, 0, 1), 0.5, 100}};
  for (const double x : {0.12, -0.12}) branches.push_back({glm::normalize(Vec3(x, 1, 0)), 0.5, 100});
  std::vector<HullRing> rings = rings_of(branches);
  for (std::size_t i = 0; i < rings.size(); ++i) rings[i].distance = branches[i].radius / std::tan(rings[i].angle);
  REQUIRE(rings[3].distance > 4 * rings[1].distance);
  const HullJoint joint = hull_joint(rings, 4);
  std::vector<Vec3> places;
  for (const HullRing& ring : rings) {
    for (int j = 0; j < 4; ++j) places.push_back(ring.distance / std::cos(ring.angle) * ring_direction(ring, j, 4));
  }
  places.insert(places.end(), joint.extra.begin(), joint.extra.end());
  REQUIRE(!joint.extra.empty());
  for (const auto& triangle : joint.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 middle = 0.5 * (places[triangle[i]] + places[triangle[(i + 1) % 3]]);
      double nearest = 1e9;  // in radii
      for (const HullBranch& branch : branches) {
        const double t = std::max(0.0, glm::dot(middle, branch.direction));
        nearest = std::min(nearest, glm::length(middle - t * branch.direction) / branch.radius);
      }
      CHECK(nearest <= kJointReach * (1 + 1e-9));
    }
  }
}

TEST_CASE("rings beyond double precision are refused") {
  const Vec3 near = glm::normalize(Vec3(1e-12, 1, 0));
  CHECK_THROWS_AS(hull_joint(rings_of({{near, 1, 9}, {Vec3(0, 1, 0), 1, 9}}), 4), InputError);
}
