// The room that branches need at a joint, and their order around it.

#include "subdivision/joint.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Contains;

namespace {

Vec3 in_plane(double degrees) { return {std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0}; }

JointBranch branch(double degrees, double radius, InternodeId id = 0) { return {in_plane(degrees), radius, id}; }

}  // namespace

TEST_CASE("two cylinders cut at their clearances touch in one point") {
  for (const double angle : {20.0, 45.0, 90.0, 120.0}) {
    for (const double r1 : {0.2, 0.5, 1.0}) {
      for (const double r2 : {0.4, 1.0}) {
        CAPTURE(angle, r1, r2);
        const double d1 = clearance(r1, r2, angle * kDegree), d2 = clearance(r2, r1, angle * kDegree);
        // The corners of both ends on the sides that face each other.
        const Vec3 corner1 = d1 * in_plane(0) + r1 * in_plane(90);
        const Vec3 corner2 = d2 * in_plane(angle) + r2 * in_plane(angle - 90);
        if (d1 > 0 && d2 > 0 && r1 + r2 * std::cos(angle * kDegree) > 0) {
          CHECK(glm::distance(corner1, corner2) == Approx(0).margin(1e-12));
        } else {
          // One begins in the joint: the other's corner lies in the plane of its end.
          const double from_end = d1 > 0 ? glm::dot(corner1, in_plane(angle)) : glm::dot(corner2, in_plane(0));
          CHECK(from_end == Approx(0).margin(1e-12));
        }
      }
    }
  }
}

TEST_CASE("the clearance of a cylinder from one at right angles is the other's radius") {
  CHECK(clearance(0.3, 2, 90 * kDegree) == Approx(2));
  CHECK(clearance(2, 0.3, 90 * kDegree) == Approx(0.3));
}

TEST_CASE("cylinders of different radii that go nearly opposite ways need little room") {
  CHECK(clearance(0.5, 1, 179.9 * kDegree) < 0.001);
  CHECK(clearance(1, 0.5, 179.9 * kDegree) == 0);
}

TEST_CASE("clearance is continuous in the angle") {
  for (double angle = 5; angle < 179.5; angle += 0.01) {
    const double step = clearance(0.4, 1, (angle + 0.01) * kDegree) - clearance(0.4, 1, angle * kDegree);
    // The derivative of cosecant and cotangent is at most 1.4 / sin^2.
    REQUIRE(std::abs(step) <= 0.01 * kDegree * 1.41 / std::pow(std::sin(5 * kDegree), 2));
  }
}

TEST_CASE("every branch keeps clear of the one that needs most room") {
  const std::vector<JointBranch> branches{branch(-90, 1), branch(90, 0.8), branch(20, 0.3)};
  const std::vector<double> offsets = clearances(branches);
  CHECK(offsets[0] == Approx(clearance(1, 0.3, 110 * kDegree)));
  CHECK(offsets[1] == Approx(clearance(0.8, 0.3, 70 * kDegree)));
  CHECK(offsets[2] == Approx(std::max(clearance(0.3, 1, 110 * kDegree), clearance(0.3, 0.8, 70 * kDegree))));
}

TEST_CASE("branches are sorted counter-clockwise from the one that carries them") {
  const std::vector<JointBranch> branches{branch(-90, 1), branch(200, 1), branch(90, 1), branch(-20, 1),
                                          branch(91.5, 1)};
  CHECK(around(branches, {0, 0, 1}) == std::vector<std::uint32_t>{0, 3, 2, 4, 1});
  CHECK(around(branches, {0, 0, -1}) == std::vector<std::uint32_t>{0, 1, 4, 2, 3});
}

TEST_CASE("the branching plane is the one in which the branches lie") {
  const Vec3 normal = branching_plane(std::vector{branch(-90, 1), branch(30, 1), branch(100, 1)}, 0.001);
  CHECK(glm::distance(normal, Vec3(0, 0, 1)) < 1e-12);
}

TEST_CASE("a branch out of the plane is refused by name, or projected") {
  std::vector<JointBranch> branches{branch(-90, 1, 3), branch(50, 1, 4), branch(130, 1, 5), branch(90, 1, 6)};
  branches[3].direction = glm::normalize(Vec3(0, 1, 1));
  CHECK_THROWS_WITH(branching_plane(branches, 30), Contains("internode 6 leaves the plane") && Contains("hull"));
  CHECK_NOTHROW(branching_plane(branches, 90));
}

TEST_CASE("branches in the same direction are refused by name") {
  CHECK_THROWS_WITH(branching_plane(std::vector{branch(-90, 1, 0), branch(50, 1, 1), branch(50.5, 1, 2)}, 90),
                    Contains("internodes 1 and 2") && Contains("same direction"));
  CHECK_THROWS_WITH(branching_plane(std::vector{branch(-90, 1, 0), branch(50, 1, 1), branch(-90, 1, 2)}, 90),
                    Contains("internode 2 runs back along internode 0"));
}
