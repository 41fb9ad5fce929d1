// Skeletons become branches, and frames follow them.

#include "subdivision/branches.h"

#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "subdivision/frames.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Contains;

namespace {

// A trunk of two internodes; at its tip a leader of two and a lateral; orders as a turtle gives them.
Skeleton small_tree() {
  Skeleton s;
  s.internodes.push_back({Vec3(0, 0, 0), Vec3(0, 1, 0), 0.3, 0.28, kNoInternode, 0, 1});
  s.internodes.push_back({Vec3(0, 1, 0), Vec3(0, 2, 0), 0.24, 0.2, 0, 0, 2});
  s.internodes.push_back({Vec3(0, 2, 0), Vec3(1, 3, 0), 0.1, 0.1, 1, 1, 3});
  s.internodes.push_back({Vec3(0, 2, 0), Vec3(0, 4, 0), 0.2, 0.2, 1, 0, 3});
  s.internodes.push_back({Vec3(0, 4, 0), Vec3(0, 5, 0), 0.2, 0.1, 3, 0, 5});
  return s;
}

}  // namespace

TEST_CASE("branches end where an internode has several children") {
  const Branches all = branches_of(small_tree(), BranchEnd::kAtJoints);
  REQUIRE(all.branches.size() == 3);
  CHECK(all.children == std::vector<std::uint32_t>{1, 2});
  CHECK(all.branches[0].node_count == 3);
  CHECK(all.branches[1].node_count == 2);
  CHECK(all.branches[2].node_count == 3);
  CHECK(all.branches[2].parent == 0);
  CHECK(all.branches[2].path == Approx(2));
  CHECK(all.longest_path == Approx(5));
  // The mean of both internodes where they follow each other.
  CHECK(all.axis(all.branches[0])[1].radius == Approx(0.26));
}

TEST_CASE("axes go on through joints along the children of their order") {
  const Branches all = branches_of(small_tree(), BranchEnd::kAtTips);
  REQUIRE(all.branches.size() == 2);
  CHECK(all.branches[0].node_count == 5);
  CHECK(all.branches[1].parent == 0);
  CHECK(all.branches[1].path == Approx(2));
}

TEST_CASE("a child whose base is within its parent's tip starts there, behind a wider gap it is a root") {
  Skeleton s = small_tree();
  s.internodes[2].base = Vec3(0.15, 2, 0);
  Branches all = branches_of(s, BranchEnd::kAtJoints);
  CHECK(all.axis(all.branches[1])[0].position == Vec3(0, 2, 0));
  s.internodes[2].base = Vec3(0.25, 2, 0);
  all = branches_of(s, BranchEnd::kAtJoints);
  REQUIRE(all.branches.size() == 2);
  CHECK(all.branches[1].parent == -1);
  CHECK(all.branches[0].node_count == 5);
}

TEST_CASE("points on an axis lie on the lines between its nodes") {
  const Branches all = branches_of(small_tree(), BranchEnd::kAtTips);
  const auto axis = all.axis(all.branches[0]);
  CHECK(glm::distance(point_on(axis, 3.5).position, Vec3(0, 3.5, 0)) < 1e-12);
  CHECK(point_on(axis, 4.5).radius == Approx(0.15));
  CHECK(point_on(axis, 4.5).internode == 4);
  CHECK(point_on(axis, 0).radius == Approx(0.3));
  CHECK(point_on(axis, 5).radius == Approx(0.1));
}

TEST_CASE("an internode that cannot be dressed is refused by name") {
  Skeleton s = small_tree();
  SECTION("no radius") {
    s.internodes[3].tip_radius = 0;
    CHECK_THROWS_WITH(branches_of(s, BranchEnd::kAtJoints), Contains("internode 3 has radius 0"));
  }
  SECTION("no length") {
    s.internodes[4].tip = s.internodes[4].base;
    CHECK_THROWS_WITH(branches_of(s, BranchEnd::kAtJoints), Contains("internode 4 has no length"));
  }
  SECTION("a loop") {
    s.internodes[1].parent = 3;
    CHECK_THROWS_WITH(branches_of(s, BranchEnd::kAtJoints), Contains("internode 1 has parent 3"));
  }
  SECTION("a place that is no number") {
    s.internodes[2].tip.z = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(branches_of(s, BranchEnd::kAtJoints), Contains("internode 2 has an end"));
  }
  SECTION("a place too far away for single precision") {
    s.internodes[2].tip.z = 1e30;
    CHECK_THROWS_AS(branches_of(s, BranchEnd::kAtJoints), InputError);
  }
}

TEST_CASE("parallel transport around a closed path turns a frame by the solid angle inside") {
  // From x to y to z and back to x: an octant of the sphere, pi / 2.
  const Frame start = frame_towards({1, 0, 0}, {0, 1, 0});
  const Frame end = transported(transported(transported(start, {0, 1, 0}), {0, 0, 1}), {1, 0, 0});
  CHECK(glm::dot(end.normal, start.normal) == Approx(0).margin(1e-12));
  CHECK(glm::dot(end.normal, start.binormal()) == Approx(1));
}

TEST_CASE("parallel transport in a plane keeps the plane's normal") {
  Frame frame = frame_towards({1, 0, 0}, {0, 0, 1});
  for (int i = 1; i <= 1000; ++i) {
    const double a = 37.0 * i * kDegree;
    frame = transported(frame, {std::cos(a), std::sin(a), 0});
    REQUIRE(glm::distance(frame.normal, Vec3(0, 0, 1)) < 1e-12);
  }
}

TEST_CASE("frames of all tangents are orthonormal, those that turn back included") {
  RandomSource random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random.direction(), b = i % 10 == 0 ? -a : random.direction();
    const Frame frame = transported(frame_towards(a, i % 7 == 0 ? a : random.direction()), b);
    REQUIRE(glm::dot(frame.tangent, frame.normal) == Approx(0).margin(1e-9));
    REQUIRE(glm::length(frame.normal) == Approx(1));
    REQUIRE(glm::length(frame.binormal()) == Approx(1));
  }
}
