#include "base/random.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace barkridge;

TEST_CASE("random units are uniform over their keys and depend on the keys' order") {
  CHECK(hash_keys(1, 2) != hash_keys(2, 1));
  const int count = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double u = random_unit(7, i);
    REQUIRE((0 <= u && u < 1));
    sum += u;
    squares += u * u;
  }
  // Five standard deviations of the mean of uniform numbers and of their squares.
  CHECK(std::abs(sum / count - 0.5) < 5 * std::sqrt(1.0 / 12 / count));
  CHECK(std::abs(squares / count - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / count));
}
