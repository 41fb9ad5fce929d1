#pragma once
// Skeletons that no plant has, for what has to stand any.

#include <cmath>

#include "lsystem/skeleton.h"
#include "tests/support/random_source.h"

namespace barkridge::test {

/// Up to 60 internodes in any directions, some exactly along axes and so often opposite or one upon the other, of up to
/// 20 times different radii, several at some tips, often too short for how thick they are.
inline Skeleton wild_skeleton(std::uint64_t seed) {
  RandomSource random(seed);
  Skeleton skeleton;
  const int count = random.integer(1, 60);
  const double spread = random.uniform(0, 3), length = random.uniform(0.2, 3);
  for (int i = 0; i < count; ++i) {
    const InternodeId parent = i == 0 ? kNoInternode : random.chance(0.4) ? i - 1 : random.integer(0, i - 1);
    const Vec3 base = parent == kNoInternode ? Vec3(0) : skeleton.internodes[static_cast<std::size_t>(parent)].tip;
    Vec3 direction = random.direction();
    if (random.chance(0.2)) direction = Vec3(0, 1, 0);
    if (random.chance(0.05)) direction = Vec3(0, -1, 0);
    if (random.chance(0.1)) direction = Vec3(1, 0, 0);
    const double radius = 0.3 * std::exp(random.uniform(-spread, 0));
    const Vec3 tip = base + length * std::exp(random.uniform(-1, 0)) * direction;
    skeleton.internodes.push_back({base, tip, radius, radius * random.uniform(0.1, 1.2), parent});
  }
  return skeleton;
}

}  // namespace barkridge::test
