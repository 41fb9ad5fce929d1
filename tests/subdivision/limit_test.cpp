// The limit surface, held against levels of refinement that near it.

#include "subdivision/limit.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "subdivision/loop.h"
#include "subdivision/to_mesh.h"
#include "tests/subdivision/meshes.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

double angle(const glm::vec3& a, const glm::vec3& b) {
  const glm::dvec3 u(a), v(b);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

// A wavy open sheet with irregular valences, and a wavy torus, closed.
ControlMesh wavy(std::uint64_t seed, bool closed) {
  RandomSource random(seed);
  ControlMesh mesh = closed ? torus(7, 8) : grid(6, 7);
  for (auto& p : mesh.positions) {
    if (!closed) p.z = static_cast<float>(std::sin(p.x) + std::cos(1.3 * p.y));
    p += glm::vec3(0.1 * random.in_box({Vec3(-1), Vec3(1)}));
  }
  flip_edges(mesh, random, 12);
  return mesh;
}

// How many triangles each vertex has.
std::vector<int> triangle_counts(const ControlMesh& mesh) {
  std::vector<int> counts(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) ++counts[v];
  }
  return counts;
}

}  // namespace

TEST_CASE("a vertex has the same limit from every level, and refinement goes there") {
  for (std::uint64_t seed = 200; seed < 230; ++seed) {
    CAPTURE(seed);
    const ControlMesh mesh = random_mesh(seed);
    const Mesh limit = limit_surface(mesh, 0);
    const Mesh later = limit_surface(mesh, 4);
    const ControlMesh fine = subdivide(mesh, 5);
    float worst = 0, distance = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      worst = std::max(worst, glm::length(limit.positions[v] - later.positions[v]));
      distance = std::max(distance, glm::length(limit.positions[v] - fine.positions[v]));
    }
    for (std::size_t i = 0; i < limit.texture.size(); ++i) {
      worst = std::max(worst, glm::length(limit.texture[i] - later.texture[i]));
    }
    CHECK(worst < 2e-6F);
    CHECK(distance < 0.05F);  // 5 steps of a factor of 0.63 at the worst
  }
}

TEST_CASE("the limit of an octahedron's vertex is known") {
  // Valence 4, beta = 31/256: the neighbours, which cancel, have 1 / (4 + 3 / (8 beta)) each.
  const Mesh limit = limit_surface(octahedron(), 0);
  CHECK(limit.positions[0].x == Approx(1 - 4 / (4 + 96.0 / 31)));
  for (std::size_t v = 0; v < 6; ++v) CHECK(angle(limit.normals[v], octahedron().positions[v]) < 1e-6);
}

TEST_CASE("a vertex has the same normal from every level") {
  for (const bool closed : {false, true}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      CAPTURE(closed, seed);
      ControlMesh mesh = wavy(seed, closed);
      // An edge in the midst: a crease with darts at both ends. (At the boundary it would make a corner.)
      const Triangle t = *std::find_if(mesh.triangles.begin(), mesh.triangles.end(), [](const Triangle& corners) {
        return std::all_of(corners.begin(), corners.end(),
                           [](std::uint32_t v) { return v % 8 > 0 && v % 8 < 7 && v / 8 > 0 && v / 8 < 6; });
      });
      mesh.sharp_edges = {{{t[0], t[1]}, kInfinitelySharp}, {{t[1], t[2]}, 1.3F}};
      const Mesh limit = limit_surface(mesh, 0), later = limit_surface(mesh, 3);
      const std::vector<int> counts = triangle_counts(mesh);
      double worst = 0;
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (counts[v] < 7) worst = std::max(worst, angle(limit.normals[v], later.normals[v]));
      }
      CHECK(worst < 1e-3);
    }
  }
}

TEST_CASE("limit normals are those of the triangles of fine levels") {
  for (const bool closed : {false, true}) {
    for (std::uint64_t seed = 20; seed < 24; ++seed) {
      CAPTURE(closed, seed);
      const ControlMesh mesh = wavy(seed, closed);
      const Mesh limit = limit_surface(mesh, 6);
      const Mesh triangles = to_mesh(subdivide(mesh, 6));
      double worst = 0, total = 0;
      for (std::size_t v = 0; v < triangles.normals.size(); ++v) {
        const double difference = angle(limit.normals[v], triangles.normals[v]);
        total += difference;
        worst = std::max(worst, difference);
      }
      CHECK(total / static_cast<double>(triangles.normals.size()) < 0.005);
      CHECK(worst < 0.15);
    }
  }
}

TEST_CASE("creases have the mean of both sides' normals, corners that of the triangles") {
  // A roof: two planes that meet at a right angle along x.
  ControlMesh mesh = grid(4, 4);
  for (auto& p : mesh.positions) {
    p.y -= 2;
    p.z = -std::abs(p.y);
  }
  for (std::uint32_t i = 0; i < 4; ++i) mesh.sharp_edges.push_back({{10 + i, 11 + i}, kInfinitelySharp});
  const Mesh limit = limit_surface(mesh, 2);
  CHECK(angle(limit.normals[12], {0, 0, 1}) < 1e-5);
  CHECK(limit.positions[12] == glm::vec3(2, 0, 0));
  CHECK(angle(limit.normals[17], {0, 1, 1}) < 1e-5);
  CHECK(angle(limit.normals[7], {0, -1, 1}) < 1e-5);
}

TEST_CASE("very sharp is sharp for ever") {
  ControlMesh mesh = octahedron(), for_ever = mesh;
  mesh.sharp_edges = {{{0, 2}, 1e9F}, {{2, 1}, 1e9F}};
  for_ever.sharp_edges = {{{0, 2}, kInfinitelySharp}, {{2, 1}, kInfinitelySharp}};
  CHECK(limit_surface(mesh, 2).positions == limit_surface(for_ever, 2).positions);
}

TEST_CASE("a mesh of no area has normals all the same") {
  ControlMesh mesh = octahedron();
  for (auto& p : mesh.positions) p = glm::vec3(1, 2, 3);
  for (const auto& normal : limit_surface(mesh, 0).normals) CHECK(normal == glm::vec3(0, 1, 0));
  for (const auto& normal : to_mesh(mesh).normals) CHECK(normal == glm::vec3(0, 1, 0));
}
