#include "bark/dress_mesh.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "blobtree/from_skeleton.h"
#include "polygonize/polygonize.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

Mesh dressed_plant(const Skeleton& skeleton, double cell_size, const DressOptions& options) {
  const PlantTree plant = plant_from_skeleton(skeleton);
  PolygonizeOptions polygons;
  polygons.cell_size = cell_size;
  return dressed(polygonize(*compile(plant.tree), polygons), plant.tree, skeleton, plant.primitives, options);
}

template <typename T>
const std::vector<T>& attribute(const Mesh& mesh, const std::string& name) {
  for (const MeshAttribute& a : mesh.attributes) {
    if (a.name == name) return std::get<std::vector<T>>(a.values);
  }
  throw std::runtime_error("no attribute " + name);
}

}  // namespace

TEST_CASE("a cylinder's texture is its surface unrolled") {
  Skeleton skeleton = chain(2, 8, 0);
  DressOptions options;
  options.texture = {2 * 3.14159265358979 / 5, 1.5, 0};
  const Mesh mesh = dressed_plant(skeleton, 0.2, options);
  REQUIRE(mesh.texture_triangles.size() == mesh.triangles.size());
  int seen = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    bool is_inner = true;
    for (const auto v : mesh.triangles[i]) {
      is_inner = is_inner && mesh.positions[v].y > 0.5f && mesh.positions[v].y < 7.5f;
    }
    if (!is_inner) continue;
    ++seen;
    // Edges are as long in the image, in scene units, as on the mesh, but for the curvature.
    for (std::size_t c = 0; c < 3; ++c) {
      const auto a = mesh.triangles[i][c], b = mesh.triangles[i][(c + 1) % 3];
      const glm::dvec2 d = glm::dvec2(mesh.texture[mesh.texture_triangles[i][c]]) -
                           glm::dvec2(mesh.texture[mesh.texture_triangles[i][(c + 1) % 3]]);
      const double flat = std::hypot(d.x * options.texture.width, d.y * options.texture.height);
      CHECK(flat == Approx(glm::distance(Vec3(mesh.positions[a]), Vec3(mesh.positions[b]))).epsilon(0.02).margin(1e-3));
    }
    // Seen from outside, an image is not mirrored.
    const auto corner = [&](std::size_t c) { return glm::dvec2(mesh.texture[mesh.texture_triangles[i][c]]); };
    const glm::dvec2 u = corner(1) - corner(0), v = corner(2) - corner(0);
    CHECK(u.x * v.y - u.y * v.x > -1e-9);
  }
  CHECK(seen > 1000);
}

TEST_CASE("vertices name their internode and how contact deformed them") {
  const Skeleton skeleton = fork(2, 40);
  const Mesh mesh = dressed_plant(skeleton, 0.2, {});
  const auto& deformation = attribute<float>(mesh, "deformation");
  const auto& ridge = attribute<float>(mesh, "ridge");
  const auto& internode = attribute<std::int32_t>(mesh, "internode");
  float most = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (p.y < -4) {
      CHECK(internode[i] == 0);
      CHECK(deformation[i] == 0);
    }
    if (p.y > 4) {
      CHECK(internode[i] == (p.x > 0 ? 1 : 2));
      CHECK(deformation[i] == 0);
      CHECK(ridge[i] == 0);
    }
    most = std::max(most, deformation[i]);
  }
  CHECK(most > 0.1f);  // M is 0.125
  CHECK(most < 0.126f);
}

TEST_CASE("a dressed mesh has the same triangles as the bare one, and its vertices stay shared") {
  const Skeleton skeleton = random_skeleton(3, 30);
  const PlantTree plant = plant_from_skeleton(skeleton);
  PolygonizeOptions polygons;
  polygons.cell_size = 0.01;
  const Mesh bare = polygonize(*compile(plant.tree), polygons);
  const Mesh mesh = dressed(bare, plant.tree, skeleton, plant.primitives, {});
  CHECK(mesh.positions == bare.positions);
  CHECK(mesh.triangles == bare.triangles);
  CHECK(mesh.texture.size() < 2 * mesh.positions.size());
  for (const auto& triangle : mesh.texture_triangles) {
    for (const auto corner : triangle) REQUIRE(corner < mesh.texture.size());
  }
}
