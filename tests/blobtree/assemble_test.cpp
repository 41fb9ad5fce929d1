#include "blobtree/field_model.h"

#include <catch2/catch.hpp>

#include "tests/blobtree/random_trees.h"

using namespace barkridge;
using namespace barkridge::test;

TEST_CASE("a program of the primitives around a point gives the value of all of them, to the bit") {
  int left_out = 0;
  for (int seed = 0; seed < 150; ++seed) {
    const auto model = compile_model(random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 40));
    std::vector<std::uint32_t> all(model->cones.size()), near;
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    FieldProgram whole, part;
    assemble(*model, all, whole);
    REQUIRE(primitive_count_of(whole) == all.size());
    RandomSource random(static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 60; ++i) {
      const Vec3 p = random.in_box({Vec3(-kTreeExtent), Vec3(kTreeExtent)});
      near.clear();
      REQUIRE(model->supports.find({p, p}, all.size(), near));
      assemble(*model, near, part);
      left_out += static_cast<int>(all.size() - near.size());
      double expected = 0, value = 0;
      Vec3 expected_gradient(0), gradient(0);
      evaluate(*model, whole, {&p, 1}, {&expected, 1}, {&expected_gradient, 1});
      evaluate(*model, part, {&p, 1}, {&value, 1}, {&gradient, 1});
      CAPTURE(seed, p.x, p.y, p.z);
      REQUIRE(value == expected);
      REQUIRE(gradient == expected_gradient);
    }
  }
  CHECK(left_out > 1000);
}

TEST_CASE("a model of many primitives keeps few bytes for each") {
  BlobTree tree;
  std::vector<NodeId> children;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 base(0.1 * i, 0, 0);
    children.push_back(tree.add(FadedCone{base, base + Vec3(0.1, 0, 0), 0.02, 0.02, 0.02, 0.02}));
  }
  tree.add(Sum{}, std::move(children));
  CHECK(compile_model(tree)->memory() < 300 * 10000);
}
