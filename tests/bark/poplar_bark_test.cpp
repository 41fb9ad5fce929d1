#include "bark/poplar_bark.h"

#include <catch2/catch.hpp>

#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

TEST_CASE("a footprint much wider than the pattern sees one colour and no bumps") {
  PoplarBark bark;
  RandomSource random(5);
  for (const double radius : {0.01, 0.5}) {
    Color lowest(1), highest(0);
    for (int i = 0; i < 300; ++i) {
      BranchPoint at;
      at.radius = radius;
      const double turn = random.uniform(0, 6.28);
      at.position = {radius * std::sin(turn), random.uniform(0, 20), radius * std::cos(turn)};
      const PatternPoint seen = poplar_bark(bark, at, 10 * bark.scale);
      lowest = glm::min(lowest, seen.color);
      highest = glm::max(highest, seen.color);
      CHECK(glm::length(seen.height.slope) < 0.02);
    }
    CHECK(highest.x - lowest.x < 0.05);
  }
}
