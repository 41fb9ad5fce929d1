// Adaptive subdivision: closed, within its tolerance, and on the limit surface.

#include "subdivision/adaptive.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "base/error.h"
#include "tests/subdivision/meshes.h"
#include "tests/support/mesh_checks.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

glm::dvec3 normal(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return glm::cross(b - a, c - a);
}

// The greatest angle, in degrees, at which two triangles meet.
double greatest_angle(const Mesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, std::size_t> triangle_of;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) triangle_of[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = t;
  }
  double greatest = 0;
  for (const auto& [edge, t] : triangle_of) {
    const auto other = triangle_of.find({edge[1], edge[0]});
    if (other == triangle_of.end()) continue;
    const glm::dvec3 a = normal(mesh, mesh.triangles[t]), b = normal(mesh, mesh.triangles[other->second]);
    greatest = std::max(greatest, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
  }
  return greatest * 180 / std::numbers::pi;
}

// A long thin torus: much curvature one way, little the other.
ControlMesh ring() {
  ControlMesh mesh = torus(5, 12);
  for (auto& p : mesh.positions) p.x *= 4;
  return mesh;
}

AdaptiveOptions within(double degrees, int max_level) {
  AdaptiveOptions options;
  options.max_angle_degrees = degrees;
  options.max_level = max_level;
  return options;
}

}  // namespace

TEST_CASE("closed meshes stay closed under adaptive subdivision, with as many handles") {
  for (const double degrees : {40.0, 15.0, 6.0}) {
    CAPTURE(degrees);
    CHECK(require_closed_manifold(subdivide_adaptively(octahedron(), within(degrees, 8))).genus == 0);
    CHECK(require_closed_manifold(subdivide_adaptively(ring(), within(degrees, 8))).genus == 1);
  }
}

TEST_CASE("no triangles meet at more than the angle asked for") {
  for (const double degrees : {30.0, 12.0, 5.0}) {
    CAPTURE(degrees);
    for (const ControlMesh& mesh : {octahedron(), ring()}) {
      const Mesh fine = subdivide_adaptively(mesh, within(degrees, 10));
      CHECK(greatest_angle(fine) <= degrees + 1e-9);
      // Uniform subdivision needs a level at which everything is this fine, and more triangles.
      int level = 0;
      while (greatest_angle(limit_surface(mesh, level)) > degrees) ++level;
      CHECK(fine.triangles.size() <= limit_surface(mesh, level).triangles.size());
    }
  }
}

TEST_CASE("random surfaces are closed by adaptive subdivision as they were before") {
  for (std::uint64_t seed = 300; seed < 330; ++seed) {
    CAPTURE(seed);
    const ControlMesh mesh = random_mesh(seed);
    AdaptiveOptions options = within(25, 5);
    options.min_area = 1e-4;
    const Mesh fine = subdivide_adaptively(mesh, options);
    Mesh coarse;
    coarse.positions = mesh.positions;
    coarse.triangles = mesh.triangles;
    const MeshReport before = examine(coarse), after = examine(fine);
    CHECK(fine.triangles.size() > mesh.triangles.size());
    CHECK(after.invalid_triangles + after.nonmanifold_edges + after.misoriented_edges + after.nonmanifold_vertices ==
          0);
    CHECK(after.unused_vertices == 0);
    CHECK(after.euler_characteristic == before.euler_characteristic);
    CHECK((after.boundary_edges == 0) == (before.boundary_edges == 0));
    CHECK(fine.texture_triangles.size() == fine.triangles.size());
  }
}

TEST_CASE("every vertex of adaptive subdivision is one of the uniform limit surface, with its normal") {
  for (std::uint64_t seed = 400; seed < 406; ++seed) {
    CAPTURE(seed);
    const ControlMesh mesh = random_mesh(seed);
    AdaptiveOptions options = within(20, 3);
    options.min_area = 5e-3;
    const Mesh adaptive = subdivide_adaptively(mesh, options);
    const Mesh uniform = limit_surface(mesh, 3);
    CHECK(adaptive.triangles.size() < uniform.triangles.size());
    double worst = 0;
    for (std::size_t i = 0; i < adaptive.positions.size(); ++i) {
      double least = 1;
      for (std::size_t j = 0; j < uniform.positions.size(); ++j) {
        least = std::min<double>(least, glm::length(adaptive.positions[i] - uniform.positions[j]));
      }
      worst = std::max(worst, least);
    }
    CHECK(worst < 2e-6);
  }
}

TEST_CASE("every vertex of adaptive subdivision has the internode and age that uniform subdivision gives it") {
  for (std::uint64_t seed = 400; seed < 406; ++seed) {
    CAPTURE(seed);
    ControlMesh mesh = random_mesh(seed);
    RandomSource random(seed);
    mesh.internodes.clear();
    mesh.ages.clear();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      mesh.internodes.push_back(random.integer(0, 1000));
      mesh.ages.push_back(static_cast<float>(random.uniform(0, 50)));
    }
    AdaptiveOptions options = within(20, 3);
    options.min_area = 5e-3;
    const Mesh adaptive = subdivide_adaptively(mesh, options), uniform = limit_surface(mesh, 3);
    const auto values = [](const Mesh& of, std::size_t i) { return of.attributes.at(i).values; };
    for (const Mesh* of : {&adaptive, &uniform}) {
      REQUIRE(of->attributes.size() == 2);
      CHECK(of->attributes[0].name == "internode");
      CHECK(of->attributes[1].name == "age");
    }
    const auto internodes = std::get<std::vector<std::int32_t>>(values(adaptive, 0)),
               uniform_internodes = std::get<std::vector<std::int32_t>>(values(uniform, 0));
    const auto ages = std::get<std::vector<float>>(values(adaptive, 1)),
               uniform_ages = std::get<std::vector<float>>(values(uniform, 1));
    REQUIRE(internodes.size() == adaptive.positions.size());
    REQUIRE(ages.size() == adaptive.positions.size());
    std::size_t found = 0;
    for (std::size_t i = 0; i < adaptive.positions.size(); ++i) {
      for (std::size_t j = 0; j < uniform.positions.size(); ++j) {
        if (glm::length(adaptive.positions[i] - uniform.positions[j]) > 2e-6F) continue;
        if (internodes[i] != uniform_internodes[j] || std::abs(ages[i] - uniform_ages[j]) > 1e-4F) continue;
        ++found;
        break;
      }
    }
    CHECK(found == adaptive.positions.size());
  }
  CHECK(subdivide_adaptively(octahedron(), within(20, 3)).attributes.empty());
}

TEST_CASE("what may not be split further is left") {
  CHECK(subdivide_adaptively(octahedron(), within(1, 0)).triangles.size() == 8);
  CHECK(subdivide_adaptively(octahedron(), within(1e-3, 2)).triangles.size() == 128);
  AdaptiveOptions coarse = within(1e-3, 8);
  coarse.min_area = 0.01;
  const Mesh mesh = subdivide_adaptively(octahedron(), coarse);
  double greatest = 0;
  for (const Triangle& t : mesh.triangles) greatest = std::max(greatest, glm::length(normal(mesh, t)) / 2);
  CHECK(greatest <= 0.01);
  CHECK(mesh.triangles.size() < 2048);
}

TEST_CASE("boundaries and creases turn by no more than the angle, corners as they are") {
  const ControlMesh mesh = grid(1, 1);
  // Two triangles in a plane: only the boundary asks for more.
  const Mesh fine = subdivide_adaptively(mesh, within(10, 8));
  std::map<std::uint32_t, std::uint32_t> next;
  std::map<std::array<std::uint32_t, 2>, int> edges;
  for (const Triangle& t : fine.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    if (edges.count({edge[1], edge[0]}) == 0) next[edge[0]] = edge[1];
  }
  double greatest = 0;
  for (const auto& [a, b] : next) {
    const glm::dvec3 u(fine.positions[b] - fine.positions[a]), v(fine.positions[next.at(b)] - fine.positions[b]);
    greatest = std::max(greatest, std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
  }
  CHECK(greatest * 180 / std::numbers::pi <= 10);
  CHECK(next.size() > 30);

  ControlMesh sharp = mesh;
  for (std::uint32_t v = 0; v < 4; ++v) sharp.sharp_vertices.push_back({v, kInfinitelySharp});
  CHECK(subdivide_adaptively(sharp, within(10, 8)).triangles.size() == 2);
  ControlMesh box = octahedron();
  for (const Triangle& t : box.triangles) {
    for (std::size_t i = 0; i < 3; ++i) box.sharp_edges.push_back({{t[i], t[(i + 1) % 3]}, kInfinitelySharp});
  }
  CHECK(subdivide_adaptively(box, within(10, 8)).triangles.size() == 8);
}

TEST_CASE("the chart of a tube covers the whole picture once under adaptive subdivision") {
  ControlMesh mesh = tube(4, 5);
  for (auto& p : mesh.positions) p.x += 0.3F * p.z * p.z;
  const Mesh fine = subdivide_adaptively(mesh, within(12, 8));
  CHECK(examine(fine).euler_characteristic == 0);
  double area = 0;
  for (const Triangle& t : fine.texture_triangles) {
    const glm::dvec2 a(fine.texture[t[0]]), b(fine.texture[t[1]]), c(fine.texture[t[2]]);
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    CHECK(twice > 0);
    area += twice / 2;
  }
  CHECK(area == Approx(1));
}

TEST_CASE("limits of adaptive subdivision are errors, and threads change nothing") {
  AdaptiveOptions options = within(2, 10);
  options.loop.max_triangles = 1000;
  CHECK_THROWS_AS(subdivide_adaptively(octahedron(), options), LimitError);
  CHECK_THROWS_AS(subdivide_adaptively(octahedron(), within(0, 4)), InputError);
  CHECK_THROWS_AS(subdivide_adaptively(octahedron(), within(10, 40)), InputError);
  const auto make = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return subdivide_adaptively(ring(), within(4, 8));
  };
  const Mesh one = make(1), two = make(2);
  CHECK(one.triangles.size() > 8192);  // more than one block of leaves
  CHECK(one.positions == two.positions);
  CHECK(one.normals == two.normals);
  CHECK(one.triangles == two.triangles);
}
