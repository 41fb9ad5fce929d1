#include "blobtree/cone_kernels.h"

#include <hwy/targets.h>

#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "blobtree/primitive_bounds.h"
#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// Values and gradients of many random cones at many points, in one row.
std::vector<double> kernel_results() {
  RandomSource random(31);
  std::vector<double> all;
  constexpr std::size_t kPoints = 40;
  for (int i = 0; i < 200; ++i) {
    std::array<std::array<double, kPoints>, 3> p;
    for (auto& column : p) {
      for (double& x : column) x = random.uniform(-1.5, 1.5);
    }
    std::array<std::array<double, kPoints>, 4> out{};
    const PointBatch points{p[0].data(), p[1].data(), p[2].data(), kPoints};
    const FieldColumns columns{out[0].data(), out[1].data(), out[2].data(), out[3].data()};
    const Vec3 axis = random.direction();
    const double length = random.uniform(0.1, 1.5), r0 = random.uniform(0.1, 0.6), r1 = random.uniform(0.1, 0.6);
    if (i % 2) {
      const Cone cone{Vec3(0), length * axis, r0, r1};
      evaluate_cone({cone, axis, length, (r1 - r0) / length, support_of(cone)}, points, columns);
    } else {
      const FadedCone cone{Vec3(0), length * axis, r0, r1, random.chance(0.6) ? r0 : 0, random.chance(0.6) ? r1 : 0};
      evaluate_faded_cone({cone, FadedConeFrame(cone), support_of(cone)}, points, columns);
    }
    for (const auto& column : out) all.insert(all.end(), column.begin(), column.end());
  }
  return all;
}

}  // namespace

TEST_CASE("every instruction set computes the same bits") {
  const std::vector<double> best = kernel_results();
  int sets = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const std::vector<double> here = kernel_results();
    CAPTURE(hwy::TargetName(target));
    CHECK(here == best);
    ++sets;
  }
  hwy::SetSupportedTargetsForTest(0);
  CHECK(sets >= 2);
}
