#include "blobtree/ridge_rules.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "blobtree/from_skeleton.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

std::vector<InternodeId> children_of_trunk(const Skeleton& skeleton) {
  std::vector<InternodeId> children;
  for (std::size_t i = 1; i < skeleton.internodes.size(); ++i) children.push_back(static_cast<InternodeId>(i));
  return children;
}

// The shape of the tree's only contact.
ContactShape shape_in(const BlobTree& tree) {
  for (const Node& node : tree.nodes) {
    if (const Contact* contact = std::get_if<Contact>(&node.what)) return contact->shape;
  }
  FAIL("there is no contact");
  return {};
}

}  // namespace

TEST_CASE("a fork's angle and ratio are those of its two thickest branches") {
  const Skeleton skeleton = junction({{70, 180, 0.3}, {10, 0, 0.8}, {35, 0, 0.6}});
  const Fork fork = fork_of(skeleton, 0, children_of_trunk(skeleton));
  CHECK(fork.order == 0);
  CHECK(fork.angle_degrees == Approx(25));
  CHECK(fork.radius_ratio == Approx(0.75));
  CHECK(fork_of(skeleton, kNoInternode, children_of_trunk(skeleton)).order == 0);
}

TEST_CASE("the last rule that fits shapes the ridge, and without one the tree's shape does") {
  const Skeleton skeleton = fork(2, 35);  // 70 degrees, equally thick
  TreeOptions options;
  options.contact = {0.4, 0.1, false};
  CHECK(shape_in(tree_from_skeleton(skeleton, options)) == options.contact);
  RidgeRule narrow, wide, elsewhere;
  narrow.contact = {0.2, 0.05, false};
  wide.angles_degrees = {60, 80};
  wide.contact = {0.5, 0.16, false};
  elsewhere.orders = {1, 3};
  options.ridge_rules = {narrow, wide, elsewhere};
  CHECK(shape_in(tree_from_skeleton(skeleton, options)) == wide.contact);
  options.ridge_rules = {wide, narrow, elsewhere};
  CHECK(shape_in(tree_from_skeleton(skeleton, options)) == narrow.contact);
  options.ridge_rules = {elsewhere};
  CHECK(shape_in(tree_from_skeleton(skeleton, options)) == options.contact);
  elsewhere.orders = {0, 0};
  elsewhere.radius_ratios = {0, 0.9};
  options.ridge_rules = {elsewhere};
  CHECK(shape_in(tree_from_skeleton(skeleton, options)) == options.contact);
}

TEST_CASE("a ridge of the skeleton's own goes before rules, and is refused out of range") {
  Skeleton skeleton = fork(2, 35);
  skeleton.ridges.push_back({0.3, 0.06});
  skeleton.internodes[2].ridge = 0;
  TreeOptions options;
  options.ridge_rules = {RidgeRule{}};
  CHECK(shape_in(tree_from_skeleton(skeleton, options)) == ContactShape{0.3, 0.06, false});
  skeleton.ridges[0].swelling = 0.12;
  CHECK_THROWS_AS(tree_from_skeleton(skeleton, options), InputError);
  options.contact.allow_large_swelling = true;
  CHECK(shape_in(tree_from_skeleton(skeleton, options)) == ContactShape{0.3, 0.12, true});
}

TEST_CASE("forks of different shapes agree with the reference") {
  // Two forks of one tree, each with its own ridge.
  Skeleton skeleton = fork(2, 40);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 base = skeleton.internodes[1].tip;
    skeleton.internodes.push_back({base, base + Vec3(2, 6, side * 3), 0.4, 0.4, 1, 2});
  }
  TreeOptions options;
  RidgeRule outer;
  outer.orders = {1, 9};
  outer.contact = {0.2, 0.04, false};
  options.ridge_rules = {outer};
  const BlobTree tree = tree_from_skeleton(skeleton, options);
  const auto fast = compile(tree), slow = reference_field(tree);
  RandomSource random(11);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = (i % 2 ? skeleton.internodes[1].tip : Vec3(0)) + random.in_box({Vec3(-2), Vec3(2)});
    double f = 0, g = 0;
    fast->values({&p, 1}, {&f, 1});
    slow->values({&p, 1}, {&g, 1});
    CHECK(f == Approx(g).margin(1e-5));
  }
}
