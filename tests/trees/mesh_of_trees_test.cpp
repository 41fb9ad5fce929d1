// Whole trees through the polygonizer.

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

#include "blobtree/from_skeleton.h"
#include "polygonize/polygonize.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

double thinnest_radius(const Skeleton& skeleton) {
  double thinnest = skeleton.internodes.front().base_radius;
  for (const Internode& a : skeleton.internodes) thinnest = std::min({thinnest, a.base_radius, a.tip_radius});
  return thinnest;
}

// The distance between two segments, by sampling one of them finely enough for the purpose.
double distance_between(const Internode& a, const Internode& b) {
  double nearest = glm::distance(a.base, b.base);
  for (int i = 0; i <= 60; ++i) {
    const Vec3 p = a.base + (i / 60.0) * (a.tip - a.base);
    const Vec3 axis = b.tip - b.base;
    const double t = std::clamp(glm::dot(p - b.base, axis) / glm::dot(axis, axis), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, b.base + t * axis));
  }
  return nearest;
}

// Whether internodes that do not meet at a node come so near that their surfaces may: then the tree may have handles.
bool may_touch_itself(const Skeleton& skeleton) {
  const auto& all = skeleton.internodes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool meet = all[i].parent == static_cast<InternodeId>(k) || all[i].parent == all[k].parent;
      if (meet) continue;
      const double reach =
          std::max(all[i].base_radius, all[i].tip_radius) + std::max(all[k].base_radius, all[k].tip_radius);
      if (distance_between(all[i], all[k]) < 2.2 * reach) return true;
    }
  }
  return false;
}

// As fine as the program takes by itself.
constexpr double kCellsARadius = 2;

Mesh mesh_of(const Skeleton& skeleton, JunctionKind junction, double cells_a_radius) {
  TreeOptions options;
  options.junction = junction;
  PolygonizeOptions cells;
  cells.cell_size = thinnest_radius(skeleton) / cells_a_radius;
  return polygonize(*compile(tree_from_skeleton(skeleton, options)), cells);
}

// `least_plain`: how many of them must be free of near misses, so that their lack of handles is tested at all.
void check_trees(std::uint64_t first_seed, int count, int internodes, int least_plain) {
  int plain = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(count); ++seed) {
    const Skeleton skeleton = random_skeleton(seed, internodes);
    const bool handles_possible = may_touch_itself(skeleton);
    plain += !handles_possible;
    for (const JunctionKind junction : {JunctionKind::kRidge, JunctionKind::kSmooth}) {
      CAPTURE(seed, junction == JunctionKind::kRidge);
      const MeshReport report = test::require_closed_manifold(mesh_of(skeleton, junction, kCellsARadius));
      CHECK(report.components == 1);
      CHECK(report.volume > 0);
      if (!handles_possible) CHECK(report.genus == 0);
    }
  }
  CHECK(plain >= least_plain);
}

}  // namespace

TEST_CASE("random trees of both junction kinds become one closed manifold each, without handles") {
  check_trees(0, 200, 14, 30);
}

TEST_CASE("displaced random trees become closed manifolds whose vertices lie on the displaced surface") {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const Skeleton skeleton = random_skeleton(seed, 8);
    TreeOptions options;
    options.junction = seed % 2 ? JunctionKind::kRidge : JunctionKind::kSmooth;
    options.displacement.amount = 0.12;
    options.displacement.octaves = 2;
    options.displacement.ridged = seed % 4 < 2;
    const BlobTree tree = tree_from_skeleton(skeleton, options);
    const auto field = compile(tree);
    PolygonizeOptions cells;
    cells.cell_size = std::min(0.5 * barkridge::thinnest_radius(tree), 0.25 * finest_wavelength(tree));
    CAPTURE(seed);
    const MeshReport report = test::require_closed_manifold(polygonize(*field, cells));
    CHECK(report.components == 1);
    // Closed creases are off the surface.
    cells.close_creases = false;
    const Mesh mesh = polygonize(*field, cells);
    test::require_closed_manifold(mesh);
    const auto oracle = reference_field(tree);
    std::size_t off = 0;
    for (const glm::vec3& position : mesh.positions) {
      const Vec3 p(position);
      double value = 0;
      Vec3 gradient;
      oracle->values_and_gradients({&p, 1}, {&value, 1}, {&gradient, 1});
      off += std::abs(value - kIsoValue) > 2e-3 * cells.cell_size * glm::length(gradient) + 2e-5;
    }
    CHECK(off <= mesh.positions.size() / 1000);  // where the gradient jumps at a crease, or nearly vanishes
  }
}

TEST_CASE("larger random trees become one closed manifold each", "[long]") { check_trees(5000, 30, 40, 1); }

TEST_CASE("a tree's mesh is the same to the bit on one thread and on two") {
  const Skeleton skeleton = random_skeleton(3, 30);
  std::vector<Mesh> meshes;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    meshes.push_back(mesh_of(skeleton, JunctionKind::kRidge, kCellsARadius));
  }
  REQUIRE(meshes[0].triangles == meshes[1].triangles);
  REQUIRE(meshes[0].positions.size() == meshes[1].positions.size());
  CHECK(std::memcmp(meshes[0].positions.data(), meshes[1].positions.data(),
                    meshes[0].positions.size() * sizeof(glm::vec3)) == 0);
  CHECK(std::memcmp(meshes[0].normals.data(), meshes[1].normals.data(), meshes[0].normals.size() * sizeof(glm::vec3)) ==
        0);
}

TEST_CASE("a mesh's vertices lie on the surface and its normals along the gradient") {
  const Skeleton skeleton = random_skeleton(8, 20);
  const auto field = reference_field(tree_from_skeleton(skeleton));
  int off_surface = 0, examined = 0;
  const Mesh mesh = mesh_of(skeleton, JunctionKind::kRidge, kCellsARadius);
  const double cell = thinnest_radius(skeleton) / kCellsARadius;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 7) {
    const Vec3 p(mesh.positions[i]);
    double value = 0;
    Vec3 gradient;
    field->values_and_gradients({&p, 1}, {&value, 1}, {&gradient, 1});
    // Vertices keep a thousandth of a cell from lattice points, and are rounded to float.
    const double tolerance = 2e-3 * cell * (glm::length(gradient) + 1 / thinnest_radius(skeleton));
    off_surface += std::abs(value - kIsoValue) > tolerance;
    ++examined;
  }
  // But for those that close the bottoms of creases.
  CHECK(off_surface < examined / 200);
  CHECK(examined > 1000);
}
