#include "mesh/topology.h"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/mesh_checks.h"

using namespace barkridge;
using barkridge::test::require_closed_manifold;

namespace {

Mesh tetrahedron(const glm::vec3& at = glm::vec3(0)) {
  return {{at, at + glm::vec3(1, 0, 0), at + glm::vec3(0, 1, 0), at + glm::vec3(0, 0, 1)},
          {},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

void append(Mesh& mesh, const Mesh& other) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

// A torus of rows x columns quads, each in two triangles.
Mesh grid_torus(std::uint32_t rows, std::uint32_t columns) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const float u = 6.2831853f * static_cast<float>(i) / static_cast<float>(rows);
      const float v = 6.2831853f * static_cast<float>(j) / static_cast<float>(columns);
      const float r = 2 + std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
      const std::uint32_t a = i * columns + j, b = (i + 1) % rows * columns + j;
      const std::uint32_t c = (i + 1) % rows * columns + (j + 1) % columns, d = i * columns + (j + 1) % columns;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("a tetrahedron is one closed sphere") {
  const MeshReport report = require_closed_manifold(tetrahedron());
  CHECK(report.triangles == 4);
  CHECK(report.edges == 6);
  CHECK(report.components == 1);
  CHECK(report.euler_characteristic == 2);
  CHECK(report.genus == 0);
  CHECK(report.volume == Approx(1.0 / 6));
  CHECK(report.area == Approx(1.5 + std::sqrt(3.0) / 2));
}

TEST_CASE("a torus has one handle, and pieces are counted") {
  Mesh mesh = grid_torus(16, 12);
  CHECK(require_closed_manifold(mesh).genus == 1);
  append(mesh, tetrahedron({10, 0, 0}));
  append(mesh, grid_torus(5, 4));
  for (std::size_t i = 16 * 12 + 4; i < mesh.positions.size(); ++i) mesh.positions[i].z += 20;
  const MeshReport report = require_closed_manifold(mesh);
  CHECK(report.components == 3);
  CHECK(report.genus == 2);
}

TEST_CASE("volumes far from the origin are exact") {
  CHECK(examine(tetrahedron({4096, -4096, 4096})).volume == Approx(1.0 / 6).epsilon(1e-12));
}

TEST_CASE("an inside-out mesh has negative volume") {
  Mesh mesh = tetrahedron();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const MeshReport report = examine(mesh);
  CHECK(report.closed_manifold());
  CHECK(report.volume == Approx(-1.0 / 6));
}

TEST_CASE("a missing triangle leaves three boundary edges") {
  Mesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  const MeshReport report = examine(mesh);
  CHECK(report.boundary_edges == 3);
  CHECK(report.nonmanifold_vertices == 0);
  CHECK_FALSE(report.closed_manifold());
  CHECK_FALSE(report.genus.has_value());
  CHECK_THAT(report.first_fault, Catch::Contains("vertex 1 at (1, 0, 0) to vertex 2 at (0, 1, 0)"));
}

TEST_CASE("a flipped triangle makes three misoriented edges") {
  Mesh mesh = tetrahedron();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  const MeshReport report = examine(mesh);
  CHECK(report.misoriented_edges == 3);
  CHECK(report.boundary_edges == 0);
  CHECK_FALSE(report.closed_manifold());
}

TEST_CASE("two tetrahedra that share an edge are not manifold there") {
  Mesh mesh = tetrahedron();
  mesh.positions.insert(mesh.positions.end(), {{0.5f, -1, 0}, {0.5f, -1, -1}});
  for (const auto& t : tetrahedron().triangles) {
    const std::array<std::uint32_t, 4> vertex{0, 1, 4, 5};
    mesh.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
  }
  const MeshReport report = examine(mesh);
  CHECK(report.nonmanifold_edges == 1);
  CHECK(report.nonmanifold_vertices == 2);
  CHECK_FALSE(report.closed_manifold());
  CHECK_THAT(report.first_fault, Catch::Contains("vertex 0") && Catch::Contains("vertex 1"));
}

TEST_CASE("two tetrahedra that share a vertex are not manifold there") {
  Mesh mesh = tetrahedron();
  append(mesh, tetrahedron({-1, -1, -1}));
  for (auto& t : mesh.triangles) {
    for (auto& v : t) v = v == 4 ? 0 : v;
  }
  const MeshReport report = examine(mesh);
  CHECK(report.nonmanifold_vertices == 1);
  CHECK(report.nonmanifold_edges == 0);
  CHECK(report.unused_vertices == 1);
  CHECK(report.components == 1);
  CHECK_FALSE(report.closed_manifold());
}

TEST_CASE("triangles without area and vertices in one place are found") {
  Mesh mesh = tetrahedron();
  mesh.positions[3] = {0.5f, 0.5f, 0};
  CHECK(examine(mesh).degenerate_triangles == 1);
  mesh.positions[3] = {-0.0f, 1, 0};
  const MeshReport report = examine(mesh);
  CHECK(report.coincident_vertices == 1);
  CHECK(report.closed_manifold());
  mesh.positions[3] = {std::numeric_limits<float>::quiet_NaN(), 1, 0};
  CHECK(examine(mesh).degenerate_triangles == 3);
}

TEST_CASE("triangles that cannot be are left out and reported") {
  Mesh mesh = tetrahedron();
  mesh.triangles.push_back({0, 1, 99});
  mesh.triangles.push_back({2, 2, 1});
  const MeshReport report = examine(mesh);
  CHECK(report.invalid_triangles == 2);
  CHECK(report.boundary_edges == 0);
  CHECK_FALSE(report.closed_manifold());
  CHECK_THAT(report.first_fault, Catch::Contains("0, 1, 99"));
}

TEST_CASE("nothing is a closed manifold without pieces") {
  const MeshReport report = require_closed_manifold({});
  CHECK(report.components == 0);
  CHECK(report.genus == 0);
  CHECK(report.volume == 0);
}
