// Pairs of triangles that cross, by hand, by trying all, and by CGAL.

#include "study/crossings.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <catch2/catch.hpp>

#include "base/random.h"

using namespace barkridge;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Mesh random_heap(std::uint64_t seed, std::uint32_t count) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto random = [&](int k) { return static_cast<float>(random_unit(seed, i, k)); };
    const glm::vec3 middle(random(0), random(1), random(2));
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back(
          middle + 0.3F * glm::vec3(random(3 + 3 * corner), random(4 + 3 * corner), random(5 + 3 * corner)));
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

Kernel::Triangle_3 exact(const Mesh& mesh, std::size_t t) {
  const auto point = [&](int corner) {
    const glm::vec3& p = mesh.positions[mesh.triangles[t][static_cast<std::size_t>(corner)]];
    return Kernel::Point_3(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
  };
  return {point(0), point(1), point(2)};
}

}  // namespace

TEST_CASE("triangles that cross are counted once, those that are apart or share a vertex not at all") {
  Mesh mesh;
  mesh.positions = {{-1, 0, -1},  {1, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0},
                    {0.1F, 0, 3}, {0, 5, 0},  {1, 5, 0}, {0, 6, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  CHECK(crossing_pairs(mesh) == 1);
  mesh.triangles = {{0, 1, 2}, {6, 7, 8}};
  CHECK(crossing_pairs(mesh) == 0);
  mesh.triangles = {{0, 1, 2}, {3, 4, 2}};
  CHECK(crossing_pairs(mesh) == 0);
  CHECK(crossing_pairs(Mesh{}) == 0);
}

TEST_CASE("as many pairs cross in random heaps as CGAL finds by trying all") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Mesh mesh = random_heap(seed, 400);
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (std::size_t j = i + 1; j < mesh.triangles.size(); ++j) {
        pairs += CGAL::do_intersect(exact(mesh, i), exact(mesh, j)) ? 1 : 0;
      }
    }
    CHECK(pairs > 200);
    CHECK(crossing_pairs(mesh) == pairs);
  }
}
