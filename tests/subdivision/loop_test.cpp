// Uniform subdivision: what theory says of it.

#include "subdivision/loop.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "subdivision/fractal_noise.h"
#include "subdivision/limit.h"
#include "subdivision/ring.h"
#include "subdivision/to_mesh.h"
#include "tests/subdivision/meshes.h"
#include "tests/support/mesh_checks.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Contains;

namespace {

// Twice the signed area that a triangle has in the texture.
double texture_area(const ControlMesh& mesh, const Triangle& t) {
  const glm::dvec2 a(mesh.texture[t[0]]), b(mesh.texture[t[1]]), c(mesh.texture[t[2]]);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool same(const ControlMesh& a, const ControlMesh& b) {
  return a.positions == b.positions && a.triangles == b.triangles && a.texture == b.texture &&
         a.texture_triangles == b.texture_triangles && a.ages == b.ages && a.internodes == b.internodes;
}

}  // namespace

TEST_CASE("closed meshes stay closed, with as many handles") {
  for (int level = 0; level <= 4; ++level) {
    CHECK(require_closed_manifold(to_mesh(subdivide(octahedron(), level))).genus == 0);
    CHECK(require_closed_manifold(to_mesh(subdivide(torus(), level))).genus == 1);
  }
}

TEST_CASE("an octahedron keeps its symmetry, and its first step is known") {
  const ControlMesh mesh = subdivide(octahedron(), 1);
  // Valence 4: beta = (5/8 - (3/8)^2) / 4 = 31/256; opposite neighbours cancel.
  CHECK(mesh.positions[0].x == Approx(1 - 4 * 31.0 / 256));
  // Between (1, 0, 0) and (0, 1, 0): 3/8 of both, 1/8 of (0, 0, 1) and (0, 0, -1), which cancel.
  const glm::vec3 expected(0.375F, 0.375F, 0);
  CHECK(std::find(mesh.positions.begin(), mesh.positions.end(), expected) != mesh.positions.end());
}

TEST_CASE("weights of neighbours are Loop's") {
  CHECK(neighbour_weight(3) == Approx(3.0 / 16));
  CHECK(neighbour_weight(6) == Approx(1.0 / 16));
  CHECK(neighbour_weight(4) == Approx(31.0 / 256));
}

TEST_CASE("a regular sheet in a plane stays as it is inside") {
  const ControlMesh mesh = subdivide(grid(6, 6), 2);
  std::size_t inside = 0;
  for (std::size_t v = 0; v < 49; ++v) {
    const glm::vec3 p(static_cast<float>(v % 7), static_cast<float>(v / 7), 0);
    if (p.x < 2 || p.x > 4 || p.y < 2 || p.y > 4) continue;
    ++inside;
    CHECK(glm::length(mesh.positions[v] - p) < 1e-6F);
  }
  CHECK(inside == 9);
}

TEST_CASE("sharp vertices stay, and corners where they are kept") {
  ControlMesh mesh = grid(2, 2);
  mesh.sharp_vertices = {{4, kInfinitelySharp}, {8, 1.0F}};
  mesh.positions[4].z = 3;
  LoopOptions keep;
  keep.keep_corners = true;
  const ControlMesh kept = subdivide(mesh, 3, keep), smooth = subdivide(mesh, 3);
  CHECK(smooth.positions[4] == mesh.positions[4]);
  // Vertices 2 and 6 are corners of one triangle, 0 and 8 of two.
  CHECK(kept.positions[2] == mesh.positions[2]);
  CHECK(smooth.positions[2] != mesh.positions[2]);
  CHECK(kept.positions[0] != mesh.positions[0]);
  CHECK(subdivide(mesh, 1).positions[8] == mesh.positions[8]);
  CHECK(smooth.positions[8] != mesh.positions[8]);
}

TEST_CASE("sharpness is used up a step at a time") {
  ControlMesh mesh = octahedron();
  mesh.sharp_edges = {{{0, 2}, 1.5F}, {{2, 1}, kInfinitelySharp}};
  mesh.sharp_vertices = {{4, 2.5F}};
  const ControlMesh once = subdivide(mesh, 1), twice = subdivide(mesh, 2);
  REQUIRE(once.sharp_edges.size() == 4);
  CHECK(once.sharp_edges[0].sharpness == 0.5F);
  CHECK(once.sharp_vertices[0].sharpness == 1.5F);
  CHECK(twice.sharp_edges.size() == 4);
  CHECK(twice.sharp_edges[0].sharpness == kInfinitelySharp);
  CHECK_NOTHROW(check(once));
  CHECK_NOTHROW(check(twice));
}

TEST_CASE("ages are interpolated, and new vertices dress the younger internode") {
  ControlMesh mesh = octahedron();
  mesh.ages = {4, 4, 2, 2, 3, 3};
  mesh.internodes = {0, 0, 1, 1, 0, 0};
  const ControlMesh fine = subdivide(mesh, 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      const std::uint32_t middle = fine.triangles[4 * t + i][(i + 1) % 3];
      CHECK(fine.ages[middle] == (mesh.ages[a] + mesh.ages[b]) / 2);
      CHECK(fine.internodes[middle] == std::max(mesh.internodes[a], mesh.internodes[b]));
      CHECK(fine.ages[a] == mesh.ages[a]);
    }
  }
}

TEST_CASE("seams stay seams: the chart of a tube covers the whole picture once at every level") {
  for (int level = 0; level <= 4; ++level) {
    const ControlMesh mesh = subdivide(tube(5, 7), level);
    double area = 0;
    for (const Triangle& t : mesh.texture_triangles) {
      CHECK(texture_area(mesh, t) > 0);
      area += texture_area(mesh, t) / 2;
    }
    CHECK(area == Approx(1));
    // A column of vertices has two places in the picture, which are in step.
    CHECK(mesh.texture.size() == mesh.positions.size() + (std::size_t{5} << level) + 1);
  }
}

TEST_CASE("texture coordinates that vertices share are told apart") {
  ControlMesh mesh = octahedron();
  mesh.texture = {{0.25F, 0.5F}};
  mesh.texture_triangles.assign(8, {0, 0, 0});
  const ControlMesh fine = subdivide(mesh, 2);
  CHECK(fine.texture.size() == fine.positions.size());
  for (const auto& uv : fine.texture) CHECK(glm::length(uv - mesh.texture[0]) < 1e-6F);
}

TEST_CASE("vertices without triangles stay where they are") {
  ControlMesh mesh = octahedron();
  mesh.positions.emplace_back(7, 8, 9);
  const ControlMesh fine = subdivide(mesh, 2);
  CHECK(fine.positions[6] == glm::vec3(7, 8, 9));
  CHECK(limit_surface(mesh, 1).positions[6] == glm::vec3(7, 8, 9));
  CHECK(subdivide(ControlMesh{}, 30).triangles.empty());
}

TEST_CASE("limits and wrong arguments are errors before any work") {
  LoopOptions options;
  options.max_triangles = 500;
  CHECK(subdivide(octahedron(), 2, options).triangles.size() == 128);
  CHECK_THROWS_AS(subdivide(octahedron(), 4, options), LimitError);
  CHECK_THROWS_WITH(subdivide(octahedron(), 3, options), Contains("level 3") && Contains("512") && Contains("500"));
  CHECK_THROWS_AS(subdivide(octahedron(), 1000), LimitError);
  CHECK_THROWS_AS(subdivide(octahedron(), -1), InputError);
  ControlMesh broken = octahedron();
  broken.triangles[3][2] = 17;
  CHECK_THROWS_AS(subdivide(broken, 1), InputError);
}

TEST_CASE("any number of threads makes the same bytes") {
  ControlMesh mesh = random_mesh(5);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) mesh.ages.push_back(static_cast<float>(v % 7));
  FractalNoise noise;
  noise.amplitude = 0.1;
  const auto make = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return std::make_pair(subdivide(mesh, 5), subdivide_with_noise(mesh, 5, noise));
  };
  const auto one = make(1), two = make(2);
  CHECK(same(one.first, two.first));
  CHECK(same(one.second, two.second));
}
