#pragma once
// Repeatable random numbers for tests: the seed in a failing test's name or message is all it takes to run it again.

#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/geometry.h"
#include "base/random.h"

namespace barkridge::test {

class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : seed_(seed) {}

  double unit() { return random_unit(seed_, count_++); }
  double uniform(double lo, double hi) { return lo + (hi - lo) * unit(); }
  int integer(int lo, int hi) { return lo + static_cast<int>(unit() * (hi - lo + 1)); }
  bool chance(double probability) { return unit() < probability; }
  Vec3 in_box(const Box& box) {
    const double x = unit(), y = unit(), z = unit();
    return box.lo + Vec3(x, y, z) * (box.hi - box.lo);
  }
  Vec3 direction() {
    const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::uint64_t seed_, count_ = 0;
};

}  // namespace barkridge::test
