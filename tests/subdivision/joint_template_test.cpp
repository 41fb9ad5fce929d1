// Every combination of cross-sections closes its joint.

#include "subdivision/joint_template.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <tuple>

#include "tests/subdivision/dressed_mesh.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// A joint in the plane z = 0 whose rings are closed by caps, and everything that it is made of.
struct CappedJoint {
  Mesh mesh;
  std::size_t joint_triangles = 0;
};

struct PlacedRing {
  double degrees, distance = 4, radius = 1;
};

// Rings around the origin; bit i of the mask says that ring i is edge-forward.
CappedJoint capped_joint(const std::vector<PlacedRing>& placed, unsigned edge_forward) {
  CappedJoint result;
  Mesh& mesh = result.mesh;
  std::vector<JointRing> rings;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    JointRing ring;
    ring.edge_forward = (edge_forward >> i & 1) != 0;
    const auto [degrees, distance, radius] = placed[i];
    const double a = degrees * kDegree;
    const Vec3 out(std::cos(a), std::sin(a), 0), next_side(-std::sin(a), std::cos(a), 0);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t k = 0; k < 6; ++k) {
      const double psi = (60.0 * k + (ring.edge_forward ? 30 : 0)) * kDegree;
      mesh.positions.emplace_back(distance * out +
                                  radius * (std::cos(psi) * Vec3(0, 0, 1) + std::sin(psi) * next_side));
      ring.vertices[k] = first + k;
    }
    mesh.positions.emplace_back(distance * out);
    for (std::uint32_t k = 0; k < 6; ++k) {
      mesh.triangles.push_back({first + (k + 1) % 6, first + k, first + 6});
    }
    rings.push_back(ring);
  }
  const std::size_t caps = mesh.triangles.size();
  triangulate_joint(rings, mesh.positions, {0, 0, 1}, mesh.triangles);
  result.joint_triangles = mesh.triangles.size() - caps;
  return result;
}

}  // namespace

TEST_CASE("all combinations of vertex-forward and edge-forward rings close the joints of two to seven branches") {
  const std::vector<std::vector<PlacedRing>> joints{{{-90}, {30}, {150}},
                                                    {{-90}, {0}, {90}, {180}},
                                                    {{-90}, {-20}, {60}, {130}, {200}},
                                                    {{-90}, {-35}, {20}, {75}, {150}, {210}},
                                                    {{-90}, {-45}, {0}, {45}, {90}, {140}, {190}, {230}}};
  for (const auto& rings : joints) {
    for (unsigned mask = 0; mask < 1U << rings.size(); ++mask) {
      CAPTURE(rings.size(), mask);
      const CappedJoint joint = capped_joint(rings, mask);
      const MeshReport report = require_closed_manifold(joint.mesh);
      REQUIRE(report.components == 1);
      REQUIRE(report.genus == 0);
      REQUIRE(report.unused_vertices == 0);
      // Euler's formula: 6 n vertices make a sphere of 12 n - 4 triangles, of which n hexagons take 4 each.
      REQUIRE(joint.joint_triangles == 8 * rings.size() - 4);
      REQUIRE(report.volume > 0);
    }
  }
}

TEST_CASE("a joint's front and back mirror each other") {
  for (unsigned mask = 0; mask < 8; ++mask) {
    CAPTURE(mask);
    const CappedJoint joint = capped_joint({{-90}, {30}, {150}}, mask);
    const auto& positions = joint.mesh.positions;
    std::vector<std::array<glm::vec3, 3>> front, back;
    // Compares what lies entirely in front with what lies entirely behind.
    for (const auto& t : joint.mesh.triangles) {
      std::array<glm::vec3, 3> corners{positions[t[0]], positions[t[1]], positions[t[2]]};
      const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::tuple(a.x, a.y) < std::tuple(b.x, b.y);
      };
      const bool all_front = corners[0].z > 0.1 && corners[1].z > 0.1 && corners[2].z > 0.1;
      const bool all_back = corners[0].z < -0.1 && corners[1].z < -0.1 && corners[2].z < -0.1;
      std::sort(corners.begin(), corners.end(), less);
      if (all_front) front.push_back(corners);
      if (all_back) back.push_back(corners);
    }
    REQUIRE(front.size() == back.size());
    for (const auto& f : front) {
      const bool found = std::any_of(back.begin(), back.end(), [&](const auto& b) {
        for (int i = 0; i < 3; ++i) {
          if (glm::distance(f[i] * glm::vec3(1, 1, -1), b[i]) > 1e-5) return false;
        }
        return true;
      });
      CHECK(found);
    }
  }
}

TEST_CASE("all 8 right and 8 left asymmetric templates join a collar to a trunk without crossing") {
  for (const bool right : {true, false}) {
    for (unsigned mask = 0; mask < 8; ++mask) {
      CAPTURE(right, mask);
      const PlacedRing carrier{-90, 0.6, 1}, neighbour{90, 0.6, 1}, collar{right ? 10.0 : 170.0, 1.2, 0.3};
      const CappedJoint joint =
          capped_joint(right ? std::vector{carrier, collar, neighbour} : std::vector{carrier, neighbour, collar}, mask);
      CHECK(require_closed_manifold(joint.mesh).genus == 0);
      CHECK(crossings(joint.mesh) == 0);
    }
  }
}
