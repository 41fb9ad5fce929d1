// A sample of the wild trees that bench/dependable.cpp counts.

#include "tests/support/dependability.h"

#include <catch2/catch.hpp>

#include "blobtree/from_skeleton.h"
#include "polygonize/polygonize.h"
#include "tests/support/mesh_checks.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

TreeOptions options_of(JunctionKind junction, BlendingKind blending) {
  TreeOptions options;
  options.junction = junction;
  options.blending = blending;
  return options;
}

}  // namespace

TEST_CASE("the probes find what they are for: a neck, a swelling and a ring") {
  // A lone internode with a thinner, a thicker and a fluted axis in its place.
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0), Vec3(0, 20, 0), 1, 1});
  const auto with_radius = [&](double radius) {
    Skeleton other = skeleton;
    other.internodes[0].base_radius = other.internodes[0].tip_radius = radius;
    return dependability_of(skeleton, *compile(tree_from_skeleton(other)));
  };
  CHECK(with_radius(0.9).necking.value == Approx(0.1).margin(1e-3));
  CHECK(with_radius(1.1).swelling.value == Approx(0.1).margin(1e-3));
  CHECK(with_radius(1).holds());
  BlobTree fluted;
  std::vector<NodeId> parts{fluted.add(Cone{Vec3(0), Vec3(0, 20, 0), 1, 1})};
  parts.push_back(fluted.add(Cone{Vec3(0, 10, 0), Vec3(0, 10, 0), 1.04, 1.04}));
  fluted.add(Union{}, parts);
  CHECK(dependability_of(skeleton, *compile(fluted)).ring.value == Approx(0.04).margin(2e-3));
}

TEST_CASE("a smooth bend of the surface off its axis is no ring, and one around it is") {
  // A gentle corner, which the surface rounds by more than 5 % on its outside, and the same with a ball around one of
  // the probes.
  const Skeleton skeleton = junction({{20, 0, 1}}, 24);
  const Dependability rounded = dependability_of(skeleton, *compile(tree_from_skeleton(skeleton)));
  CHECK(rounded.holds());
  CHECK(rounded.rounding.value > 0.05);
  BlobTree fluted = tree_from_skeleton(skeleton);
  const NodeId plant = fluted.root;
  const NodeId ball = fluted.add(Cone{Vec3(0, -1, 0), Vec3(0, -1, 0), 1.04, 1.04});
  fluted.add(Union{}, {plant, ball});
  CHECK(dependability_of(skeleton, *compile(fluted)).ring.value == Approx(0.04).margin(5e-3));
}

TEST_CASE("wild trees keep the radii of their internodes") {
  const std::vector<TreeOptions> all{options_of(JunctionKind::kRidge, BlendingKind::kSubtrees),
                                     options_of(JunctionKind::kSmooth, BlendingKind::kSubtrees),
                                     options_of(JunctionKind::kSmooth, BlendingKind::kConfined)};
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Skeleton skeleton = wild_skeleton(seed);
    for (const TreeOptions& options : all) {
      const Dependability found = dependability_of(skeleton, *compile(tree_from_skeleton(skeleton, options)));
      CAPTURE(seed, options.junction == JunctionKind::kRidge, options.blending == BlendingKind::kConfined);
      CHECK(found.missing == 0);
      CHECK(found.swelling.value <= 0.05);
      CHECK(found.necking.value <= 0.05);
      CHECK(found.ring.value <= 0.01);
    }
  }
}

TEST_CASE("wild trees become one closed manifold each: nothing floats") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Skeleton skeleton = wild_skeleton(seed, 12);
    double thinnest = 1;
    for (const Internode& a : skeleton.internodes) thinnest = std::min({thinnest, a.base_radius, a.tip_radius});
    for (const JunctionKind junction : {JunctionKind::kRidge, JunctionKind::kSmooth}) {
      PolygonizeOptions cells;
      cells.cell_size = 0.5 * thinnest;
      const auto field = compile(tree_from_skeleton(skeleton, options_of(junction, BlendingKind::kConfined)));
      CAPTURE(seed, junction == JunctionKind::kRidge);
      CHECK(require_closed_manifold(polygonize(*field, cells)).components == 1);
    }
  }
}
