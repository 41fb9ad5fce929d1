#include "blobtree/cone_kernels.h"

#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "blobtree/falloff.h"
#include "blobtree/primitive.h"
#include "tests/blobtree/instruction_sets.h"
#include "tests/blobtree/random_trees.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

FadedCone random_faded_cone(RandomSource& random) {
  const auto radius = [&] { return random.uniform(0.1, 0.6); };
  const Vec3 base = random.in_box({Vec3(-1), Vec3(1)});
  return {base,
          base + random.uniform(0.1, 1.5) * random.direction(),
          radius(),
          radius(),
          random.chance(0.6) ? radius() : 0,
          random.chance(0.6) ? radius() : 0};
}

}  // namespace

TEST_CASE("every instruction set agrees with the plain formulas of cones to 1e-5") {
  const int sets = on_every_instruction_set([] {
    RandomSource random(31);
    constexpr std::size_t kPoints = 48;
    int differing = 0;
    for (int i = 0; i < 400; ++i) {
      const FadedCone faded = random_faded_cone(random);
      const Cone plain{faded.base, faded.tip, faded.base_radius, faded.tip_radius};
      const bool is_faded = i % 2 == 0;
      std::array<std::array<float, kPoints>, 3> p;
      std::array<std::array<float, kPoints>, 4> out;
      for (auto& column : p) {
        for (float& x : column) x = static_cast<float>(random.uniform(-1.5, 1.5));
      }
      const ConeRecord record = is_faded ? record_of(faded, 1) : record_of(plain, 1);
      const LocalCone local = local_cone(record, is_faded ? kind_of_faded(record) : ConeKind::kPlain, Vec3(0), 1);
      sum_cones({&local, 1}, {Vec3(0), {p[0].data(), p[1].data(), p[2].data()}, kPoints},
                {out[0].data(), {out[1].data(), out[2].data(), out[3].data()}});
      for (std::size_t k = 0; k < kPoints; ++k) {
        const Vec3 point(p[0][k], p[1][k], p[2][k]);
        const FieldSample expected = is_faded ? sample(faded, point) : sample(plain, point);
        CAPTURE(i, k, is_faded, expected.value, out[0][k]);
        REQUIRE(std::abs(out[0][k] - expected.value) <= 1e-5);
        // Across a limit of the radius the gradient may jump, and rounding may put a point on either side.
        const Vec3 gradient(out[1][k], out[2][k], out[3][k]);
        differing += glm::distance(gradient, expected.gradient) > 1e-4 * (1 + glm::length(expected.gradient));
      }
    }
    CHECK(differing <= 4);
  });
  CHECK(sets >= 2);
}

TEST_CASE("random trees agree with the reference on every instruction set to 1e-5") {
  on_every_instruction_set([] {
    for (int seed = 0; seed < 40; ++seed) {
      const BlobTree tree = random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 30);
      const auto reference = reference_field(tree), compiled = compile(tree);
      RandomSource random(32 + static_cast<std::uint64_t>(seed));
      std::vector<Vec3> points(100);
      for (Vec3& p : points) p = random.in_box({Vec3(-kTreeExtent), Vec3(kTreeExtent)});
      std::vector<double> expected(points.size()), values(points.size());
      reference->values(points, expected);
      compiled->values(points, values);
      for (std::size_t i = 0; i < points.size(); ++i) {
        CAPTURE(seed, i);
        REQUIRE(std::abs(values[i] - expected[i]) <= 1e-5 * (1 + std::abs(expected[i])));
      }
    }
  });
}
