// Simple and compound leaves.

#include "subdivision/leaf_mesh.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "base/error.h"
#include "tests/subdivision/dressed_mesh.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Contains;

TEST_CASE("1 000 random leaves are discs, oriented, with a midrib to every tip") {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const Skeleton skeleton = random_planar_skeleton(seed, 1 + static_cast<int>(seed % 40));
    LeafOptions options;
    options.texture = seed % 2 == 0 ? LeafTexture::kWhole : LeafTexture::kLobes;
    options.point_length = seed % 3 == 0 ? 0 : 1.5;
    const ControlMesh mesh = leaf_mesh(skeleton, options);
    const MeshReport report = require_dressed(mesh);
    require_ages(mesh, skeleton);
    REQUIRE(report.components == 1);
    REQUIRE(report.euler_characteristic == 1);
    // The midrib is a tree: one crease less than it has vertices, and it ends at base and tips.
    std::map<std::uint32_t, int> midrib;
    for (const auto& edge : mesh.sharp_edges) {
      for (const std::uint32_t v : edge.vertices) ++midrib[v];
    }
    REQUIRE(mesh.sharp_edges.size() == midrib.size() - 1);
    std::set<InternodeId> carrying;
    for (const Internode& internode : skeleton.internodes) carrying.insert(internode.parent);
    carrying.erase(kNoInternode);
    const std::size_t tips = skeleton.internodes.size() - carrying.size();
    const auto ends = std::count_if(midrib.begin(), midrib.end(), [](const auto& entry) { return entry.second == 1; });
    REQUIRE(static_cast<std::size_t>(ends) == tips + 1);
    REQUIRE(mesh.sharp_vertices.size() == (options.point_length > 0 ? tips : 0));
  }
}

TEST_CASE("a flat leaf has the area of its strips and looks up") {
  LeafOptions options;
  options.fold_degrees = 0;
  options.point_length = 2;
  Skeleton skeleton = chain(5, 10, 0.05);
  const ControlMesh mesh = leaf_mesh(skeleton, options);
  // Half widths 1, 0.75, 0.5 at 0, 5, 10; a point one long.
  CHECK(examine(surface_of(mesh)).area == Approx(5 * 1.75 + 5 * 1.25 + 0.5));
  for (const auto& t : mesh.triangles) {
    const Vec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    CHECK(glm::cross(b - a, c - a).z > 0);
  }
}

TEST_CASE("a leaf's halves are raised by the fold, and the midrib lies on the axis") {
  LeafOptions options;
  options.fold_degrees = 30;
  const ControlMesh mesh = leaf_mesh(chain(5, 10, 0), options);
  int margins = 0;
  for (const glm::vec3& p : mesh.positions) {
    if (p.x == 0) {
      CHECK(p.z == 0);
      continue;
    }
    ++margins;
    CHECK(std::abs(p.x) == Approx(std::cos(30 * kDegree)));
    CHECK(p.z == Approx(0.5));
  }
  CHECK(margins == 6);
}

TEST_CASE("neighbouring lobes start at a common vertex, so that a fork of n lies flat without crossing") {
  for (std::size_t count = 2; count <= 6; ++count) {
    CAPTURE(count);
    std::vector<test::Branch> branches;
    for (std::size_t i = 0; i < count; ++i) {
      branches.push_back({-75 + 150.0 * static_cast<double>(i) / static_cast<double>(count - 1), 0, 0.3});
    }
    LeafOptions options;
    options.fold_degrees = 0;
    options.texture = LeafTexture::kLobes;
    const ControlMesh mesh = leaf_mesh(junction(branches, 8), options);
    // Base, end of trunk; margins at both ends of branches, merged between neighbours at one; midribs and points.
    CHECK(mesh.positions.size() == 6 + (2 * count - (count - 1)) + 2 * count + 3 * count);
    const auto normal = [&](const std::array<std::uint32_t, 3>& t) {
      const Vec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
      return glm::cross(b - a, c - a).z;
    };
    for (const auto& t : mesh.triangles) CHECK(normal(t) > 0);
  }
}

TEST_CASE("a whole leaf's texture is its flat shape, however it bends") {
  // A chain that bends out of its plane by 20 degrees a step unrolls to a straight one.
  Skeleton bent;
  Vec3 at(0);
  for (int i = 0; i < 6; ++i) {
    const Vec3 next = at + Vec3(0, std::cos(20 * i * kDegree), std::sin(20 * i * kDegree));
    bent.internodes.push_back({at, next, 0.5, 0.5, i - 1});
    at = next;
  }
  LeafOptions options;
  options.point_length = 0;
  const ControlMesh mesh = leaf_mesh(bent, options);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec2 uv = mesh.texture[i];
    CHECK(uv.y == Approx(static_cast<double>(i / 3) / 6).margin(1e-6));
    CHECK(uv.x == Approx(static_cast<double>(i % 3) / 12).margin(1e-6));
  }
  // A flat leaf is its own texture, up to scale and place.
  options.fold_degrees = 0;
  const ControlMesh flat = leaf_mesh(junction({{40, 0, 0.5}, {-40, 0, 0.5}, {0, 0, 0.7}}), options);
  glm::vec3 lo = flat.positions[0], hi = lo;
  for (const glm::vec3& p : flat.positions) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  const float size = std::max(hi.x - lo.x, hi.y - lo.y);
  for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3 p = (flat.positions[flat.triangles[t][i]] - lo) / size;
      const glm::vec2 uv = flat.texture[flat.texture_triangles[t][i]];
      CHECK(uv.x == Approx(p.x).margin(1e-5));
      CHECK(uv.y == Approx(p.y).margin(1e-5));
    }
  }
}

TEST_CASE("leaf options out of range are refused by name") {
  LeafOptions options;
  options.fold_degrees = 90;
  CHECK_THROWS_WITH(leaf_mesh(chain(5, 10, 0), options), Contains("fold_degrees is 90"));
  options = {};
  options.midrib_sharpness = -1;
  CHECK_THROWS_WITH(leaf_mesh(chain(5, 10, 0), options), Contains("midrib_sharpness is -1"));
  options = {};
  options.point_length = -1;
  CHECK_THROWS_WITH(leaf_mesh(chain(5, 10, 0), options), Contains("point_length is -1"));
}
