#include "blobtree/box_hierarchy.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

Box random_box(RandomSource& random, double largest) {
  const Vec3 center = random.in_box({Vec3(-1), Vec3(1)});
  const double size = largest * std::pow(10.0, random.uniform(-3, 0));
  const Vec3 half = size * Vec3(random.unit(), random.unit(), random.unit());
  return {center - half, center + half};
}

}  // namespace

TEST_CASE("a hierarchy finds what overlaps a region, in order, as looking at every box does") {
  for (const std::size_t count : {0, 1, 7, 8, 9, 64, 65, 1000, 5000}) {
    RandomSource random(count);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) boxes.push_back(random_box(random, 0.5));
    if (count > 10) boxes[3] = Box{};
    const BoxHierarchy hierarchy(boxes);
    for (int k = 0; k < 300; ++k) {
      const Box region = random_box(random, 1);
      std::vector<std::uint32_t> expected, found;
      for (std::uint32_t i = 0; i < count; ++i) {
        if (boxes[i].overlaps(region)) expected.push_back(i);
      }
      REQUIRE(hierarchy.find(region, count, found));
      CAPTURE(count, k);
      // Boxes are rounded outward to floats; random ones do not touch to within that.
      REQUIRE(found == expected);
      if (expected.empty()) continue;
      found.clear();
      REQUIRE_FALSE(hierarchy.find(region, expected.size() - 1, found));
    }
  }
}

TEST_CASE("a box of the hierarchy holds the one that it was made of") {
  RandomSource random(77);
  std::vector<Box> boxes;
  for (int i = 0; i < 100; ++i) boxes.push_back(random_box(random, 0.3));
  const BoxHierarchy hierarchy(boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    CHECK(hierarchy.box(i).contains(boxes[i].lo));
    CHECK(hierarchy.box(i).contains(boxes[i].hi));
    CHECK(grown(boxes[i], 1e-6).contains(hierarchy.box(i).lo));
  }
}
