// Plants dressed by junction templates, and by separate cylinders.

#include "subdivision/template_mesh.h"

#include <catch2/catch.hpp>
#include <set>

#include "base/error.h"
#include "subdivision/cylinder_mesh.h"
#include "tests/subdivision/dressed_mesh.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Contains;

namespace {

// The vertices that dress an internode.
std::vector<Vec3> vertices_on(const ControlMesh& mesh, InternodeId internode) {
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.internodes[i] == internode) result.emplace_back(mesh.positions[i]);
  }
  return result;
}

// How many texture coordinates the vertex with most of them has.
std::size_t most_coordinates(const ControlMesh& mesh) {
  std::vector<std::set<std::uint32_t>> of(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) of[mesh.triangles[t][i]].insert(mesh.texture_triangles[t][i]);
  }
  std::size_t most = 0;
  for (const auto& coordinates : of) most = std::max(most, coordinates.size());
  return most;
}

TemplateOptions options_of(std::uint64_t seed) {
  TemplateOptions options;
  options.stem.tip = std::array{StemTip::kCapped, StemTip::kSharp, StemTip::kTapered}[seed % 3];
  options.stem.closed_base = seed % 2 == 0;
  options.stem.texture = seed % 5 < 3 ? StemTexture::kReflected : StemTexture::kCylindrical;
  options.joint.thin_ratio = seed % 7 == 0 ? 0 : 1.0 / 3;
  return options;
}

}  // namespace

TEST_CASE("1 000 random planar plants become spheres, or discs with an open base") {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const Skeleton skeleton = random_planar_skeleton(seed, 1 + static_cast<int>(seed % 60));
    const TemplateOptions options = options_of(seed);
    const ControlMesh mesh = template_mesh(skeleton, options);
    const MeshReport report = require_dressed(mesh);
    require_ages(mesh, skeleton);
    REQUIRE(report.components == 1);
    REQUIRE(report.euler_characteristic == (options.stem.closed_base ? 2 : 1));
    REQUIRE(report.boundary_edges == (options.stem.closed_base ? 0 : 6));
  }
}

TEST_CASE("joints in no plane become spheres too where they are accepted") {
  TemplateOptions options;
  options.joint.max_out_of_plane_degrees = 90;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const MeshReport report = require_dressed(template_mesh(random_skeleton(seed, 80), options));
    REQUIRE(report.closed_manifold());
    REQUIRE(report.components == 1);
    REQUIRE(report.genus == 0);
  }
}

TEST_CASE("plants of internodes much shorter than thick stay manifold") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Skeleton skeleton = random_planar_skeleton(seed, 60);
    for (Internode& internode : skeleton.internodes) {
      internode.base_radius *= 100;
      internode.tip_radius *= 100;
    }
    const MeshReport report = require_dressed(template_mesh(skeleton, {}));
    REQUIRE(report.euler_characteristic == 2 * static_cast<std::int64_t>(report.components));
    REQUIRE(report.genus == 0);
  }
}

TEST_CASE("joints with room around them do not cross themselves") {
  RandomSource random(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<test::Branch> branches;
    const int count = random.integer(2, 5);
    double angle = -130 + random.uniform(0, 25);
    for (int k = 0; k < count; ++k) {
      branches.push_back({angle, 30, random.uniform(0.1, 1)});
      angle += random.uniform(30, 250.0 / count);
    }
    CAPTURE(i, count);
    const TemplateOptions options = options_of(static_cast<std::uint64_t>(2 * i));
    const ControlMesh mesh = template_mesh(junction(branches, 20), options);
    CHECK(crossings(surface_of(mesh)) == 0);
    // Cylinders that are not joined do.
    CHECK(crossings(surface_of(cylinder_mesh(junction(branches, 20), options.stem))) > 0);
    CHECK(require_dressed(mesh).volume > 0);
  }
}

TEST_CASE("branches are cut back by the equations and dressed at their radius") {
  // At right angles: the trunk by the lateral's radius, the lateral by the trunk's; each by a gap more.
  TemplateOptions options;
  const ControlMesh mesh = template_mesh(junction({{0, 0, 1}, {90, 0, 0.5}}), options);
  double first = 10;
  for (const Vec3& v : vertices_on(mesh, 2)) {
    first = std::min(first, v.x);
    if (v.x < 9.9) CHECK(std::hypot(v.y, v.z) == Approx(0.5).epsilon(1e-6));
  }
  CHECK(first == Approx(1 + options.joint.gap * 0.5));
  double last = -10;
  for (const Vec3& v : vertices_on(mesh, 0)) last = std::max(last, v.y);
  CHECK(last == Approx(-(0.5 + options.joint.gap)));
}

TEST_CASE("a curved branch is cut back by the angle at which it parts, not that at which it starts") {
  // Two arcs that start 20 degrees apart and end square: the equations alone would take 5.7 of 12.
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0, -10, 0), Vec3(0), 1, 1});
  for (const double side : {-1.0, 1.0}) {
    Vec3 at(0);
    for (int k = 0; k < 12; ++k) {
      const double angle = side * (10 + 25 * std::min(k, 3)) * kDegree;
      const Vec3 next = at + Vec3(std::sin(angle), std::cos(angle), 0);
      const auto last = static_cast<InternodeId>(skeleton.internodes.size()) - 1;
      skeleton.internodes.push_back({at, next, 1, 1, k == 0 ? 0 : last});
      at = next;
    }
  }
  const ControlMesh mesh = template_mesh(skeleton);
  CHECK(crossings(surface_of(mesh)) == 0);
  CHECK_FALSE(vertices_on(mesh, 4).empty());
}

TEST_CASE("a branch a third as thick as its neighbour has a collar, a thicker one none") {
  const auto size = [](double radius, double thin_ratio) {
    TemplateOptions options;
    options.joint.thin_ratio = thin_ratio;
    return template_mesh(junction({{0, 0, 1}, {60, 0, radius}}), options).positions.size();
  };
  CHECK(size(0.33, 1.0 / 3) == size(0.34, 1.0 / 3) + 6);
  CHECK(size(0.33, 0) == size(0.34, 0));
}

TEST_CASE("a chain is a prism whose limit surface is five sixths as thick") {
  const ControlMesh mesh = template_mesh(chain(2, 20, 0));
  const MeshReport report = require_dressed(mesh);
  // A hexagon of circumradius 1, twenty high.
  CHECK(report.volume == Approx(20 * 1.5 * std::sqrt(3.0)).epsilon(1e-6));
  // Loop's limit mask at a regular vertex: half of it and a twelfth of each of six neighbours.
  std::vector<std::set<std::uint32_t>> neighbours(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) neighbours[t[i]].insert({t[(i + 1) % 3], t[(i + 2) % 3]});
  }
  int regular = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.positions[v].y < 3 || mesh.positions[v].y > 17) continue;
    REQUIRE(neighbours[v].size() == 6);
    Vec3 limit = 0.5 * Vec3(mesh.positions[v]);
    for (const std::uint32_t w : neighbours[v]) limit += Vec3(mesh.positions[w]) / 12.0;
    CHECK(std::hypot(limit.x, limit.z) == Approx(5.0 / 6).epsilon(1e-6));
    ++regular;
  }
  CHECK(regular == 42);
}

TEST_CASE("tips are flat and smooth, flat and creased, or pointed at the skeleton's tip") {
  TemplateOptions options;
  const Skeleton skeleton = chain(5, 10, 0.05);
  ControlMesh mesh = template_mesh(skeleton, options);
  CHECK(mesh.sharp_edges.size() == 6);  // the base's rim
  options.stem.tip = StemTip::kSharp;
  mesh = template_mesh(skeleton, options);
  CHECK(mesh.sharp_edges.size() == 12);
  options.stem.tip = StemTip::kTapered;
  mesh = template_mesh(skeleton, options);
  REQUIRE(mesh.sharp_vertices.size() == 1);
  CHECK(glm::distance(mesh.positions[mesh.sharp_vertices[0].vertex], glm::vec3(0, 10, 0)) < 1e-6F);
  CHECK(mesh.positions.size() == 2 * 6 + 2);
}

TEST_CASE("reflected texture has one coordinate a vertex, from 0 at the base to 1 at the longest path's end") {
  const Skeleton skeleton = junction({{0, 0, 1}, {60, 0, 0.5}});
  const ControlMesh mesh = template_mesh(skeleton);
  CHECK(most_coordinates(mesh) == 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p(mesh.positions[mesh.triangles[t][i]]);
      const glm::vec2 uv = mesh.texture[mesh.texture_triangles[t][i]];
      if (mesh.internodes[mesh.triangles[t][i]] != 0 || p.y < -9.9) continue;
      CHECK(uv.y == Approx((p.y + 10) / 20).margin(1e-6));
      CHECK((uv.x == 0 || uv.x == 1));
    }
  }
}

TEST_CASE("unrolled texture is a cylinder's development on walls, and goes on across a joint's sides with them") {
  TemplateOptions options;
  options.stem.texture = StemTexture::kCylindrical;
  const ControlMesh mesh = template_mesh(junction({{0, 0, 1}, {90, 0, 0.9}}), options);
  int walls = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vec3, 3> p;
    std::array<glm::dvec2, 3> uv;
    bool wall = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t][i];
      p[i] = Vec3(mesh.positions[v]);
      uv[i] = glm::dvec2(mesh.texture[mesh.texture_triangles[t][i]]);
      wall = wall && mesh.internodes[v] == 0 && std::hypot(p[i].x, p[i].z) > 0.9;
    }
    if (!wall) continue;
    ++walls;
    const double pi = 3.14159265358979;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      CHECK(uv[j].y - uv[i].y == Approx((p[j].y - p[i].y) / (2 * pi)).margin(1e-6));
      const double turned = std::atan2(p[i].z * p[j].x - p[i].x * p[j].z, p[i].x * p[j].x + p[i].z * p[j].z);
      CHECK(uv[j].x - uv[i].x == Approx(turned / (2 * pi)).margin(1e-6));
    }
  }
  CHECK(walls == 12);
}

TEST_CASE("roots are pieces of their own, and so is what grows behind a gap") {
  Skeleton skeleton = junction({{0, 0, 1}, {60, 0, 0.5}});
  skeleton.internodes.push_back({Vec3(30, 0, 0), Vec3(30, 5, 0), 1, 1});
  skeleton.internodes.push_back({Vec3(30, 8, 0), Vec3(30, 9, 0), 1, 1, 3});
  const MeshReport report = require_dressed(template_mesh(skeleton));
  CHECK(report.components == 3);
  CHECK(report.genus == 0);
  CHECK(template_mesh(Skeleton{}).positions.empty());
}

TEST_CASE("what cannot be dressed is refused by name") {
  CHECK_THROWS_WITH(template_mesh(junction({{50, 0, 1}, {50, 0, 1}})), Contains("internodes 1 and 2"));
  CHECK_THROWS_WITH(template_mesh(fork(4, 60)), Contains("hull method"));
  TemplateOptions options;
  options.joint.gap = 0;
  CHECK_THROWS_WITH(template_mesh(fork(2, 30), options), Contains("gap is 0"));
  options = {};
  options.stem.radius_scale = -1;
  CHECK_THROWS_WITH(template_mesh(fork(2, 30), options), Contains("radius_scale is -1"));
}

TEST_CASE("separate cylinders are one sphere an axis, or one disc") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const Skeleton skeleton = random_skeleton(seed, 50);
    // A trunk or lateral starts at a root and wherever the order rises.
    std::size_t axes = 0;
    for (const Internode& i : skeleton.internodes) {
      axes += i.parent == kNoInternode || skeleton.internodes[static_cast<std::size_t>(i.parent)].order < i.order;
    }
    const StemOptions options = options_of(seed).stem;
    const ControlMesh mesh = cylinder_mesh(skeleton, options);
    const MeshReport report = require_dressed(mesh);
    require_ages(mesh, skeleton);
    REQUIRE(report.components == axes);
    REQUIRE(report.euler_characteristic == static_cast<std::int64_t>(axes) * (options.closed_base ? 2 : 1));
    REQUIRE(report.boundary_edges == (options.closed_base ? 0 : 6 * axes));
  }
}
