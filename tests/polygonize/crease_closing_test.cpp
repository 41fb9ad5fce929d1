#include "polygonize/crease_closing.h"

#include <catch2/catch.hpp>
#include <functional>

using namespace barkridge;

namespace {

// Samples of a block with its halo: 1 inside, 0 outside. Coordinates count from the block's first point.
std::vector<double> samples(const std::function<bool(int x, int y, int z)>& inside) {
  std::vector<double> values;
  for (int z = -kCreaseHalo; z < kBlockPoints + kCreaseHalo; ++z) {
    for (int y = -kCreaseHalo; y < kBlockPoints + kCreaseHalo; ++y) {
      for (int x = -kCreaseHalo; x < kBlockPoints + kCreaseHalo; ++x) values.push_back(inside(x, y, z) ? 1 : 0);
    }
  }
  return values;
}

}  // namespace

TEST_CASE("a slit of one point is closed at its bottom only") {
  // Two walls with the plane x = 4 between them, joined below z = 3.
  const auto slit = samples([](int x, int, int z) { return z < 3 || x != 4; });
  const std::vector<glm::ivec3> bottoms = crease_bottoms(slit);
  CHECK(bottoms.size() == kBlockPoints);
  for (const glm::ivec3& p : bottoms) CHECK((p.x == 4 && p.z == 3));
}

TEST_CASE("a gap that does not end nearby stays open") {
  CHECK(crease_bottoms(samples([](int x, int, int) { return x != 4; })).empty());
  CHECK(crease_bottoms(samples([](int x, int, int z) { return z < 3 || (x != 4 && x != 5); })).empty());
}

TEST_CASE("a lone outside point is closed, a lone inside point stays") {
  const auto lone = [](int x, int y, int z) { return x == 4 && y == 5 && z == 6; };
  CHECK(crease_bottoms(samples([&](int x, int y, int z) { return !lone(x, y, z); })) ==
        std::vector<glm::ivec3>{{4, 5, 6}});
  CHECK(crease_bottoms(samples(lone)).empty());
}

TEST_CASE("a point on the block's border is judged with its neighbours in the halo") {
  const auto slit = samples([](int x, int, int z) { return z < 0 || x != 0; });
  const std::vector<glm::ivec3> bottoms = crease_bottoms(slit);
  CHECK(bottoms.size() == kBlockPoints);
  for (const glm::ivec3& p : bottoms) CHECK((p.x == 0 && p.z == 0));
}
