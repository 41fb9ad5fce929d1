#include <catch2/catch.hpp>

#include "blobtree/tree.h"

using namespace barkridge;

namespace {

double value(const BlobTree& tree, const Vec3& p) {
  double f = 0;
  compile(tree)->values({&p, 1}, {&f, 1});
  return f;
}

// Three spheres at one place: a field of up to 3, cut by a sphere at (1.2, 0, 0).
BlobTree strong_body() {
  BlobTree tree;
  std::vector<NodeId> spheres;
  for (int i = 0; i < 3; ++i) spheres.push_back(tree.add(Cone{Vec3(0), Vec3(0), 1, 1}));
  tree.add(Sum{}, spheres);
  return tree;
}
BlobTree cut_body() {
  BlobTree tree = strong_body();
  const NodeId body = tree.root;
  const NodeId knife = tree.add(Cone{Vec3(1.2, 0, 0), Vec3(1.2, 0, 0), 0.5, 0.5});
  tree.add(Difference{}, {body, knife});
  return tree;
}

}  // namespace

TEST_CASE("where nothing is taken away a difference is its first child, also above one") {
  const BlobTree whole = strong_body(), cut = cut_body();
  for (const Vec3& p : {Vec3(0), Vec3(-0.5, 0.2, 0), Vec3(0.1, 0.05, 0.1)}) {
    REQUIRE(value(whole, p) > 1);
    CHECK(value(cut, p) == value(whole, p));
  }
}

TEST_CASE("a difference has no jump where the second child begins") {
  const BlobTree cut = cut_body();
  double previous = value(cut, Vec3(0));
  double steepest = 0;
  const int steps = 100000;
  for (int i = 1; i <= steps; ++i) {
    const double here = value(cut, Vec3(2.0 * i / steps, 0, 0));
    steepest = std::max(steepest, std::abs(here - previous) / (2.0 / steps));
    previous = here;
  }
  // Steepest falloffs of three unit spheres and of the knife, the knife's also scaled by the body's excess of 2 over T.
  CHECK(steepest < 3 * 0.792 + 1.584 * (1 + 2 / 0.5));
}

TEST_CASE("a difference takes away just the solid of its other children") {
  const BlobTree whole = strong_body(), cut = cut_body();
  BlobTree knife;
  knife.add(Cone{Vec3(1.2, 0, 0), Vec3(1.2, 0, 0), 0.5, 0.5});
  int removed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p(-1.5 + 3.0 * (i % 20) / 20 + 0.0123, -1.5 + 3.0 * (i / 20 % 20) / 20 + 0.0071,
                 -1 + 2.0 * (i / 400) / 10);
    const bool inside = value(whole, p) >= kIsoValue && value(knife, p) < kIsoValue;
    CHECK((value(cut, p) >= kIsoValue) == inside);
    removed += value(whole, p) >= kIsoValue && !inside;
  }
  CHECK(removed > 20);
}
