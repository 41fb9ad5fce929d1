// Random trees with missing organs, bends and tips, through the polygonizer.

#include <catch2/catch.hpp>

#include "blobtree/from_skeleton.h"
#include "lsystem/prune.h"
#include "polygonize/polygonize.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// Rules for about half of the branches.
void choose(Selection& branches, std::uint64_t seed, int what) {
  branches.order = {1, 9};
  branches.fraction = 0.35;
  branches.seed = static_cast<std::int64_t>(10 * seed) + what;
}

Skeleton pruned(std::uint64_t seed, int internodes) {
  RandomSource random(900 + seed);
  std::vector<CutRule> cuts(2);
  for (int i = 0; i < 2; ++i) {
    choose(cuts[static_cast<std::size_t>(i)].branches, seed, i);
    cuts[static_cast<std::size_t>(i)].position = random.uniform(0.02, 0.98);
    cuts[static_cast<std::size_t>(i)].tilt_degrees = random.uniform(-60, 60);
  }
  cuts[1].splinters = random.uniform(0.5, 4);
  ScarRule scar;
  choose(scar.branches, seed, 2);
  scar.shape = {random.uniform(0.5, 3), random.uniform(0, 1.5), random.uniform(0, 1)};
  return prune(random_skeleton(seed, internodes), cuts, {&scar, 1});
}

double thinnest_radius(const Skeleton& skeleton) {
  double thinnest = skeleton.internodes.front().base_radius;
  for (const Internode& a : skeleton.internodes) thinnest = std::min({thinnest, a.base_radius, a.tip_radius});
  return thinnest;
}

void check_trees(std::uint64_t first_seed, std::uint64_t count, int internodes) {
  std::size_t cuts = 0, scars = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    const Skeleton skeleton = pruned(seed, internodes);
    cuts += skeleton.cut_ends.size();
    scars += skeleton.scars.size();
    TreeOptions options;
    options.junction = seed % 2 ? JunctionKind::kRidge : JunctionKind::kSmooth;
    options.blending = seed % 4 < 2 ? BlendingKind::kConfined : BlendingKind::kSubtrees;
    options.bend_angle_degrees = seed % 3 ? 0 : 30;
    options.displacement.amount = seed % 4 ? 0 : 0.1;
    if (seed % 5 == 0) options.tips.push_back({{}, seed % 10 ? TipKind::kPointed : TipKind::kBud});
    PolygonizeOptions cells;
    cells.cell_size = thinnest_radius(skeleton) / 2;
    CAPTURE(seed);
    const MeshReport report =
        test::require_closed_manifold(polygonize(*compile(tree_from_skeleton(skeleton, options)), cells));
    CHECK(report.components == 1);
    CHECK(report.volume > 0);
  }
  CHECK(cuts > count / 2);
  CHECK(scars > count / 4);
}

}  // namespace

TEST_CASE("random trees with cuts, breaks and scars stay one closed manifold each") { check_trees(0, 60, 14); }

TEST_CASE("larger random trees with cuts, breaks and scars stay one closed manifold each", "[long]") {
  check_trees(3000, 60, 40);
}
