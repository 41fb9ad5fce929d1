#include "subdivision/hull.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/error.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/skeletons.h"
#include "tests/support/wild_skeleton.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

Mesh surface_of(const ControlMesh& mesh) { return {mesh.positions, {}, mesh.triangles}; }

// Fails unless the mesh is sound and has `plants` closed pieces without handles.
MeshReport require_plants(const ControlMesh& mesh, std::size_t plants) {
  REQUIRE_NOTHROW(check(mesh));
  const MeshReport report = require_closed_manifold(surface_of(mesh));
  REQUIRE(report.components == plants);
  REQUIRE(report.euler_characteristic == 2 * static_cast<std::int64_t>(plants));
  REQUIRE(report.volume > 0);
  REQUIRE(mesh.internodes.size() == mesh.positions.size());
  REQUIRE(mesh.ages.size() == mesh.positions.size());
  REQUIRE(mesh.texture_triangles.size() == mesh.triangles.size());
  return report;
}

// The part of a circle's area that a regular polygon in it has.
double polygon_part(int corners) { return corners * std::sin(2 * std::numbers::pi / corners) / (2 * std::numbers::pi); }

HullOptions rings_of(int vertices) {
  HullOptions options;
  options.ring_vertices = vertices;
  return options;
}

std::size_t dressed_internodes(const ControlMesh& mesh) {
  return std::set<InternodeId>(mesh.internodes.begin(), mesh.internodes.end()).size();
}

}  // namespace

TEST_CASE("1000 random skeletons become closed manifolds of genus 0") {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    INFO("seed " << seed);
    const Skeleton skeleton = seed % 2 ? wild_skeleton(seed) : random_skeleton(seed, 1 + static_cast<int>(seed % 60));
    require_plants(hull_mesh(skeleton, rings_of(3 + static_cast<int>(seed % 7))), 1);
  }
}

TEST_CASE("a lone internode is a frustum in as many segments as half its girth goes into its length") {
  for (const int vertices : {3, 4, 7}) {
    Skeleton skeleton;
    skeleton.internodes.push_back({Vec3(1, 2, 3), Vec3(1, 2, 3) + Vec3(6, 2, -9), 2, 1});
    const ControlMesh mesh = hull_mesh(skeleton, rings_of(vertices));
    const MeshReport report = require_plants(mesh, 1);
    const double length = 11, cone = std::numbers::pi / 3 * length * (4 + 2 + 1);
    CHECK(report.volume == Approx(cone * polygon_part(vertices)).epsilon(1e-5));
    const int segments = 2;  // 11 / (1.5 pi) = 2.3
    CHECK(mesh.triangles.size() == static_cast<std::size_t>(vertices * (2 * segments + 2)));
    CHECK(mesh.sharp_edges.size() == static_cast<std::size_t>(2 * vertices));
    // Once around in u; the circumference is the unit of v.
    float u = 0, v = 0;
    for (const glm::vec2& t : mesh.texture) {
      u = std::max(u, t.x);
      v = std::max(v, t.y);
    }
    CHECK(u == 1);
    CHECK(v == Approx((length + 1.5) / (3 * std::numbers::pi)));  // and a radius for the end's middle
  }
}

TEST_CASE("a straight chain is one tube without seams across it") {
  const ControlMesh mesh = hull_mesh(chain(2, 20, 0.03), rings_of(6));
  const MeshReport report = require_plants(mesh, 1);
  CHECK(mesh.positions.size() == 11 * 6 + 2);
  const double end = 1 - 20 * 0.03, volume = std::numbers::pi / 3 * 20 * (1 + end + end * end);
  CHECK(report.volume == Approx(volume * polygon_part(6)).epsilon(1e-5));
  // Eleven rings of seven corners and the ends' middles, a corner a triangle.
  CHECK(mesh.texture.size() == 11 * 7 + 2 * 6);
}

TEST_CASE("whorls of any number of branches are joined") {
  for (const int count : {1, 2, 3, 6, 7, 8, 12, 20}) {
    for (const double angle : {20.0, 60.0, 90.0, 120.0, 170.0}) {
      INFO(count << " branches at " << angle << " degrees");
      std::vector<Branch> branches;
      for (int i = 0; i < count; ++i) branches.push_back({angle, 360.0 * i / count, 0.1});
      const ControlMesh mesh = hull_mesh(junction(branches, 30));
      require_plants(mesh, 1);
      CHECK(dressed_internodes(mesh) == static_cast<std::size_t>(count) + 1);
    }
  }
}

TEST_CASE("branches a thousand times thinner than their trunk are joined to it") {
  for (const double thin : {0.3, 0.03, 0.001}) {
    const ControlMesh mesh = hull_mesh(junction({{0, 0, 0.9}, {50, 0, thin}, {80, 120, thin}, {90, 240, 3 * thin}}));
    require_plants(mesh, 1);
    CHECK(dressed_internodes(mesh) == 5);
  }
}

TEST_CASE("an offset trifurcation keeps both its joints") {
  Skeleton skeleton;
  skeleton.internodes = {{Vec3(0, -6, 0), Vec3(0), 1, 1},
                         {Vec3(0), Vec3(0, 1.5, 0), 0.9, 0.9, 0},
                         {Vec3(0), Vec3(5, 4, 0), 0.5, 0.4, 0, 1},
                         {Vec3(0, 1.5, 0), Vec3(0, 7, 0), 0.8, 0.6, 1},
                         {Vec3(0, 1.5, 0), Vec3(-5, 5, 0), 0.5, 0.4, 1, 1}};
  const ControlMesh mesh = hull_mesh(skeleton);
  require_plants(mesh, 1);
  CHECK(dressed_internodes(mesh) == 5);
}

TEST_CASE("joints too close for their rings merge, and a branch inside of its joint goes") {
  Skeleton close;
  close.internodes = {{Vec3(0, -6, 0), Vec3(0), 1, 1},
                      {Vec3(0), Vec3(0, 0.02, 0), 1, 1, 0},
                      {Vec3(0), Vec3(5, 4, 0), 0.5, 0.4, 0, 1},
                      {Vec3(0, 0.02, 0), Vec3(0, 7, 0), 0.8, 0.6, 1},
                      {Vec3(0, 0.02, 0), Vec3(-5, 5, 0), 0.5, 0.4, 1, 1}};
  ControlMesh mesh = hull_mesh(close);
  require_plants(mesh, 1);
  CHECK(std::count(mesh.internodes.begin(), mesh.internodes.end(), 1) == 0);
  CHECK(dressed_internodes(mesh) == 4);

  mesh = hull_mesh([] {
    Skeleton skeleton = junction({{0, 0, 1}, {90, 0, 0.1}});
    skeleton.internodes[2].tip *= 0.09;
    return skeleton;
  }());
  require_plants(mesh, 1);
  CHECK(dressed_internodes(mesh) == 2);
}

TEST_CASE("of branches in one direction the shortest go") {
  Skeleton skeleton = junction({{30, 0, 0.3}, {30, 0, 0.3}, {30, 0, 0.2}});
  skeleton.internodes[1].tip *= 2.0;
  const ControlMesh mesh = hull_mesh(skeleton);
  require_plants(mesh, 1);
  CHECK(std::set<InternodeId>(mesh.internodes.begin(), mesh.internodes.end()) == std::set<InternodeId>{0, 1});

  // A branch that runs back over its parent has that direction too.
  skeleton = junction({});
  skeleton.internodes.push_back({Vec3(0), Vec3(0, -5, 0), 1, 1, 0});
  require_plants(hull_mesh(skeleton), 1);
}

TEST_CASE("an internode of many more times its radius has no more rings than allowed") {
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0), Vec3(0, 1e6, 0), 1, 1});
  CHECK(require_plants(hull_mesh(skeleton), 1).triangles == 4 * (2 * 64 + 2));
}

TEST_CASE("plants are what hangs together") {
  Skeleton skeleton = junction({{0, 0, 1}});
  skeleton.internodes.push_back({Vec3(20, 0, 0), Vec3(20, 5, 0), 1, 1});       // another root
  skeleton.internodes.push_back({Vec3(0, 12, 0), Vec3(0, 20, 0), 1, 1, 1});    // behind a gap
  skeleton.internodes.push_back({Vec3(20, 5.5, 0), Vec3(20, 9, 0), 1, 1, 2});  // behind none that shows
  skeleton.internodes.push_back({Vec3(20, 0, 0), Vec3(25, -5, 0), 0.5, 0.5});  // a root at another's base
  require_plants(hull_mesh(skeleton), 3);
  CHECK(hull_mesh({}).triangles.empty());
}

TEST_CASE("a tip without width is a point that stays") {
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0), Vec3(0, 3, 0), 1, 1e-7});
  const ControlMesh mesh = hull_mesh(skeleton);
  require_plants(mesh, 1);
  REQUIRE(mesh.sharp_vertices.size() == 1);
  CHECK(mesh.positions[mesh.sharp_vertices[0].vertex] == glm::vec3(0, 3, 0));
}

TEST_CASE("a plant far from the origin or smaller than single precision tells apart has no broken triangles") {
  Skeleton skeleton = random_skeleton(5, 60);
  for (Internode& internode : skeleton.internodes) {
    internode.base += Vec3(1000, 0, -1000);
    internode.tip += Vec3(1000, 0, -1000);
  }
  require_plants(hull_mesh(skeleton), 1);
  for (Internode& internode : skeleton.internodes) {
    internode.base += Vec3(1e9);
    internode.tip += Vec3(1e9);
  }
  CHECK(hull_mesh(skeleton).triangles.empty());
}

TEST_CASE("vertices know the internode they dress and its age") {
  Skeleton skeleton = junction({{0, 0, 0.9}, {60, 0, 0.4}});
  for (std::size_t i = 0; i < 3; ++i) skeleton.internodes[i].birth_step = 2 + static_cast<int>(i);
  const ControlMesh mesh = hull_mesh(skeleton);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    REQUIRE(mesh.ages[i] == static_cast<float>(2 - mesh.internodes[i]));
    // Far from the joint, the nearest axis is the vertex's own.
    const Vec3 p(mesh.positions[i]);
    if (p.y < -3) CHECK(mesh.internodes[i] == 0);
    if (p.y > 8) CHECK(mesh.internodes[i] == 1);
    if (p.x > 3) CHECK(mesh.internodes[i] == 2);
  }
}

TEST_CASE("texture coordinates have no more than the cylinder's seam along branches") {
  const ControlMesh mesh = hull_mesh(random_skeleton(9, 80));
  std::vector<int> uses(mesh.texture.size(), 0);
  for (const auto& triangle : mesh.texture_triangles) {
    for (const std::uint32_t coordinate : triangle) ++uses[coordinate];
  }
  // Inside a branch's own triangles u never runs farther than one vertex on. Those of joints have coordinates alone.
  std::size_t own = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bool is_joint = false;
    glm::vec2 lo(std::numeric_limits<float>::max()), hi(-std::numeric_limits<float>::max());
    for (const std::uint32_t corner : mesh.texture_triangles[t]) {
      is_joint = is_joint || uses[corner] == 1;
      lo = glm::min(lo, mesh.texture[corner]);
      hi = glm::max(hi, mesh.texture[corner]);
    }
    REQUIRE(std::isfinite(hi.x + hi.y + lo.x + lo.y));
    REQUIRE(hi.x - lo.x <= (is_joint ? 1.0f : 0.2501f));
    own += !is_joint;
  }
  CHECK(own > mesh.triangles.size() / 4);
}

TEST_CASE("a control mesh does not depend on the number of threads") {
  const Skeleton skeleton = random_skeleton(4, 2000);
  const ControlMesh many = hull_mesh(skeleton);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const ControlMesh one = hull_mesh(skeleton);
  CHECK(many.positions == one.positions);
  CHECK(many.triangles == one.triangles);
  CHECK(many.texture == one.texture);
  CHECK(many.texture_triangles == one.texture_triangles);
}

TEST_CASE("skeletons and options that cannot be used are refused") {
  const auto with = [](auto change) {
    Skeleton skeleton = junction({{0, 0, 1}});
    change(skeleton.internodes[1]);
    return skeleton;
  };
  using Catch::Contains;
  CHECK_THROWS_WITH(hull_mesh(with([](Internode& i) { i.parent = 1; })), Contains("internode 1 has the parent 1"));
  CHECK_THROWS_WITH(hull_mesh(with([](Internode& i) { i.parent = -2; })), Contains("internode 1 has the parent -2"));
  CHECK_THROWS_WITH(hull_mesh(with([](Internode& i) { i.base_radius = 0; })), Contains("internode 1 has the radius 0"));
  CHECK_THROWS_WITH(hull_mesh(with([](Internode& i) { i.tip_radius = INFINITY; })), Contains("radius inf"));
  CHECK_THROWS_WITH(hull_mesh(with([](Internode& i) { i.tip.y = NAN; })), Contains("not finite"));
  const Skeleton skeleton = junction({{0, 0, 1}});
  CHECK_THROWS_AS(hull_mesh(skeleton, rings_of(2)), InputError);
  HullOptions options;
  options.thinnest_ring = 0;
  CHECK_THROWS_AS(hull_mesh(skeleton, options), InputError);
  options = {};
  options.max_segments = 0;
  CHECK_THROWS_AS(hull_mesh(skeleton, options), InputError);
  options = {};
  options.max_triangles = 10;
  CHECK_THROWS_AS(hull_mesh(skeleton, options), LimitError);
}
