#include "lsystem/limbs.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// A trunk from below to the origin, with a branch up and one to the side, and from that one's end a shoot that passes
// the upright branch at a distance. All of radius 0.1.
Skeleton with_passing_shoot(double distance) {
  Skeleton skeleton;
  skeleton.internodes = {{Vec3(0, -5, 0), Vec3(0), 0.1, 0.1},
                         {Vec3(0), Vec3(0, 5, 0), 0.1, 0.1, 0},
                         {Vec3(0), Vec3(3, 0, distance), 0.1, 0.1, 0},
                         {Vec3(3, 0, distance), Vec3(-3, 6, distance), 0.1, 0.1, 2}};
  return skeleton;
}

// Between two internodes' axes, by trying many points of the one.
double sampled_distance(const Internode& a, const Internode& b) {
  const Vec3 axis = b.tip - b.base;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 2000; ++i) {
    const Vec3 p = a.base + i / 2000.0 * (a.tip - a.base);
    const double t = std::clamp(glm::dot(p - b.base, axis) / glm::dot(axis, axis), 0.0, 1.0);
    least = std::min(least, glm::length(p - b.base - t * axis));
  }
  return least;
}

}  // namespace

TEST_CASE("limbs that pass each other cross where their axes are nearer than the sum of their radii") {
  CHECK(crossing_limbs(with_passing_shoot(0.3)) == 0);
  CHECK(crossing_limbs(with_passing_shoot(0.21)) == 0);
  CHECK(crossing_limbs(with_passing_shoot(0.19)) == 1);
  CHECK(crossing_limbs(with_passing_shoot(0)) == 1);
  CHECK(crossing_limbs(with_passing_shoot(0.3), 1.6) == 1);
  CHECK(crossing_limbs({}) == 0);
}

TEST_CASE("limbs that meet at a joint or follow each other do not cross") {
  CHECK(crossing_limbs(fork(6, 10)) == 0);
  CHECK(crossing_limbs(chain(3, 30, 0)) == 0);
  Skeleton roots = fork(3, 40);  // three plants from one base
  roots.internodes.erase(roots.internodes.begin());
  for (Internode& internode : roots.internodes) internode.parent = kNoInternode;
  CHECK(crossing_limbs(roots) == 0);
  roots.internodes[0].base.x += 1e-3;
  CHECK(crossing_limbs(roots) > 0);
}

TEST_CASE("as many limbs cross in random trees as by trying all pairs at many points") {
  std::size_t all = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Skeleton skeleton = random_skeleton(seed, 60);
    const auto& internodes = skeleton.internodes;
    std::size_t pairs = 0;
    bool is_close_call = false;
    for (std::size_t a = 0; a < internodes.size(); ++a) {
      for (std::size_t b = a + 1; b < internodes.size(); ++b) {
        if (internodes[b].parent == static_cast<InternodeId>(a) || internodes[b].parent == internodes[a].parent)
          continue;
        const double apart = sampled_distance(internodes[a], internodes[b]),
                     radii = internodes[a].base_radius + internodes[b].base_radius;
        is_close_call = is_close_call || std::abs(apart - radii) < 1e-3 * radii;
        if (apart < radii) ++pairs;
      }
    }
    if (is_close_call) continue;
    CHECK(crossing_limbs(skeleton) == pairs);
    all += pairs;
  }
  CHECK(all > 20);
}
