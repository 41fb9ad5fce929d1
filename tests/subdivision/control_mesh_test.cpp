// A control mesh that breaks a rule is refused by name.

#include "subdivision/control_mesh.h"

#include <catch2/catch.hpp>

#include "base/error.h"

using namespace barkridge;
using Catch::Contains;

namespace {

// A tetrahedron, counter-clockwise from outside.
ControlMesh tetrahedron() {
  ControlMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

// Two meshes side by side in one.
ControlMesh beside(ControlMesh mesh, const ControlMesh& other) {
  const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return mesh;
}

}  // namespace

TEST_CASE("closed meshes and meshes with a boundary are control meshes") {
  CHECK_NOTHROW(check(ControlMesh{}));
  CHECK_NOTHROW(check(tetrahedron()));
  ControlMesh open = tetrahedron();
  open.triangles.pop_back();
  CHECK_NOTHROW(check(open));
  CHECK_NOTHROW(check(beside(tetrahedron(), open)));
}

TEST_CASE("a control mesh that breaks a rule is refused with the guilty element") {
  ControlMesh mesh = tetrahedron();
  SECTION("an index out of range") {
    mesh.triangles[2][1] = 4;
    CHECK_THROWS_WITH(check(mesh), Contains("triangle 2 names vertex 4"));
  }
  SECTION("a vertex twice") {
    mesh.triangles[1] = {0, 1, 1};
    CHECK_THROWS_WITH(check(mesh), Contains("triangle 1 names vertex 1 twice"));
  }
  SECTION("orientations that disagree") {
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    CHECK_THROWS_WITH(check(mesh), Contains("disagree in orientation"));
  }
  SECTION("an edge of three triangles") {
    mesh.positions.emplace_back(1, 1, 1);
    mesh.triangles.push_back({0, 2, 4});
    CHECK_THROWS_WITH(check(mesh), Contains("triangle 4 runs along the edge from vertex 0 to 2"));
  }
  SECTION("two tetrahedra that share a vertex") {
    mesh = beside(mesh, tetrahedron());
    for (auto& triangle : mesh.triangles) {
      for (auto& vertex : triangle) vertex = vertex == 4 ? 0 : vertex;
    }
    CHECK_THROWS_WITH(check(mesh), Contains("vertex 0 are not one fan"));
  }
  SECTION("a place that is no number") {
    mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH(check(mesh), Contains("position 3 is not finite"));
  }
  SECTION("a sharp edge that no triangle has") {
    mesh = beside(mesh, tetrahedron());
    mesh.sharp_edges = {{{1, 2}, 1.0F}, {{3, 4}, 1.0F}};
    CHECK_THROWS_WITH(check(mesh), Contains("sharp edge 1, from vertex 3 to 4"));
  }
  SECTION("sharpness that is none") {
    mesh.sharp_edges = {{{1, 2}, 0.0F}};
    CHECK_THROWS_WITH(check(mesh), Contains("sharp edge 0 needs a sharpness above 0"));
    mesh.sharp_edges.clear();
    mesh.sharp_vertices = {{2, -1.0F}};
    CHECK_THROWS_WITH(check(mesh), Contains("sharp vertex 0 needs a sharpness above 0"));
  }
  SECTION("ages for some vertices only") {
    mesh.ages = {1, 2};
    CHECK_THROWS_WITH(check(mesh), Contains("expected 4 ages"));
  }
}
