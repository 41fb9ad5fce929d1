#pragma once
// What tests ask of a control mesh.

#include <catch2/catch.hpp>

#include "subdivision/control_mesh.h"
#include "tests/support/mesh_checks.h"

namespace barkridge::test {

inline Mesh surface_of(const ControlMesh& mesh) { return {mesh.positions, {}, mesh.triangles}; }

/// Fails the test unless the mesh keeps all rules of a control mesh and carries all that a dressed one carries.
/// Returns its topology.
inline MeshReport require_dressed(const ControlMesh& mesh) {
  REQUIRE_NOTHROW(check(mesh));
  REQUIRE(mesh.texture_triangles.size() == mesh.triangles.size());
  REQUIRE(mesh.internodes.size() == mesh.positions.size());
  REQUIRE(mesh.ages.size() == mesh.positions.size());
  const MeshReport report = examine(surface_of(mesh));
  INFO(report.first_fault);
  REQUIRE(report.invalid_triangles == 0);
  REQUIRE(report.nonmanifold_edges == 0);
  REQUIRE(report.misoriented_edges == 0);
  REQUIRE(report.nonmanifold_vertices == 0);
  REQUIRE(report.unused_vertices == 0);
  return report;
}

/// Pairs of an edge and a triangle that cross. All against all.
inline int crossings(const Mesh& mesh) {
  int count = 0;
  const auto at = [&](std::uint32_t v) { return Vec3(mesh.positions[v]); };
  // Signed volume of a tetrahedron.
  const auto side = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
  };
  for (const auto& e : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t p = e[i], q = e[(i + 1) % 3];
      if (p > q) continue;
      for (const auto& t : mesh.triangles) {
        if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return v == p || v == q; })) continue;
        const Vec3 a = at(t[0]), b = at(t[1]), c = at(t[2]), from = at(p), to = at(q);
        if (side(a, b, c, from) * side(a, b, c, to) >= 0) continue;
        const double u = side(from, to, a, b), v = side(from, to, b, c), w = side(from, to, c, a);
        count += (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
      }
    }
  }
  return count;
}

/// The age of the internode that every vertex dresses, counted from its birth to the youngest's.
inline void require_ages(const ControlMesh& mesh, const Skeleton& skeleton) {
  std::int32_t youngest = 0;
  for (const Internode& internode : skeleton.internodes) youngest = std::max(youngest, internode.birth_step);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto internode = static_cast<std::size_t>(mesh.internodes[i]);
    REQUIRE(internode < skeleton.internodes.size());
    REQUIRE(mesh.ages[i] == youngest - skeleton.internodes[internode].birth_step);
  }
}

}  // namespace barkridge::test
