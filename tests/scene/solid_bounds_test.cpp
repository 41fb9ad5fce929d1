#include "scene/solid_bounds.h"

#include <catch2/catch.hpp>

#include "blobtree/tree.h"

using namespace barkridge;

namespace {

// `actual` encloses `expected` and is larger by at most a thousandth of the support's diagonal.
void check_bounds(const BlobTree& tree, const Box& expected) {
  const std::shared_ptr<const Field> field = compile(tree);
  const Box actual = solid_bounds(*field);
  const double tolerance = field->support().diagonal() / 1000;
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    CHECK(actual.lo[axis] <= expected.lo[axis]);
    CHECK(actual.lo[axis] >= expected.lo[axis] - tolerance);
    CHECK(actual.hi[axis] >= expected.hi[axis]);
    CHECK(actual.hi[axis] <= expected.hi[axis] + tolerance);
  }
}

}  // namespace

TEST_CASE("the bounds of a ball are its radius around its middle, not its field's reach") {
  BlobTree tree;
  tree.add(Cone{{1, 2, 3}, {1, 2, 3}, 0.5, 0.5});
  check_bounds(tree, {{0.5, 1.5, 2.5}, {1.5, 2.5, 3.5}});
}

TEST_CASE("the bounds of a disc are as good as those of round solids") {
  BlobTree tree;
  tree.add(Disc{{0, 0, 0}, {0, 1, 0}, 4, 0.5});
  check_bounds(tree, {{-4.5, -0.5, -4.5}, {4.5, 0.5, 4.5}});
}

TEST_CASE("the bounds of distant parts unite") {
  BlobTree tree;
  const NodeId a = tree.add(Cone{{-5, 0, 0}, {-5, 4, 0}, 1, 1});
  const NodeId b = tree.add(Cone{{7, 1, 2}, {7, 1, 2}, 2, 2});
  tree.add(Union{}, {a, b});
  check_bounds(tree, {{-6, -1, -1}, {9, 5, 4}});
}

TEST_CASE("a solid's reach in any direction is that of its outermost ball") {
  BlobTree tree;
  const NodeId a = tree.add(Cone{{-5, 0, 0}, {-5, 0, 0}, 1, 1});
  const NodeId b = tree.add(Cone{{7, 1, 2}, {7, 1, 2}, 2, 2});
  tree.add(Union{}, {a, b});
  const std::shared_ptr<const Field> field = compile(tree);
  for (const Vec3& direction : {Vec3(1, 1, 1), Vec3(-2, 0.5, 0.1), Vec3(0, -3, 0.2)}) {
    const double length = glm::length(direction);
    const double expected =
        std::max(glm::dot(direction, Vec3(-5, 0, 0)) + length, glm::dot(direction, Vec3(7, 1, 2)) + 2 * length);
    const std::optional<double> reach = solid_reach(*field, direction);
    REQUIRE(reach);
    CHECK(*reach >= expected);
    CHECK(*reach <= expected + length * field->support().diagonal() / 1000);
  }
}

TEST_CASE("a field without a solid has empty bounds") {
  CHECK(solid_bounds(*compile(BlobTree{})).empty());
  BlobTree hollow;
  const NodeId ball = hollow.add(Cone{});
  const NodeId same = hollow.add(Cone{});
  hollow.add(Negative{}, {ball, same});
  CHECK(solid_bounds(*compile(hollow)).empty());
}
