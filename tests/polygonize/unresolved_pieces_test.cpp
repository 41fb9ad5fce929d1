#include "polygonize/unresolved_pieces.h"

#include <catch2/catch.hpp>

#include "polygonize/polygonize.h"
#include "tests/support/mesh_checks.h"

using namespace barkridge;

namespace {

// An octahedron around a point, oriented outwards, or inwards as around a hollow.
void add_octahedron(Mesh& mesh, const glm::vec3& center, float radius, bool hollow) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {radius, -radius}) {
      glm::vec3 p = center;
      p[axis] += side;
      mesh.positions.push_back(p);
      mesh.normals.push_back(glm::normalize(hollow ? center - p : p - center));
    }
  }
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = first + (octant & 1), y = first + 2 + (octant >> 1 & 1), z = first + 4 + (octant >> 2);
    const bool mirrored = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;
    mesh.triangles.push_back(mirrored != hollow ? std::array{x, z, y} : std::array{x, y, z});
  }
}

}  // namespace

TEST_CASE("pieces too small for the lattice go, larger ones and the largest stay") {
  Mesh mesh;
  // An octahedron of radius r has r / (3 sqrt 3) of volume for each unit of its area.
  add_octahedron(mesh, {0, 0, 0}, 1, true);    // a small hollow
  add_octahedron(mesh, {0, 0, 0}, 10, false);  // the solid around it
  add_octahedron(mesh, {3, 0, 0}, 2, true);    // a larger hollow
  add_octahedron(mesh, {20, 0, 0}, 1, false);  // a speck
  const double volume = examine(mesh).volume;
  remove_unresolved_pieces(mesh, 0.7);
  const MeshReport report = test::require_closed_manifold(mesh);
  CHECK(report.components == 2);
  CHECK(mesh.positions.size() == 12);
  CHECK(mesh.normals.size() == 12);
  // The filled hollow had the volume that the speck had.
  CHECK(report.volume == Approx(volume));
  remove_unresolved_pieces(mesh, 1000);
  CHECK(examine(mesh).components == 1);
}
