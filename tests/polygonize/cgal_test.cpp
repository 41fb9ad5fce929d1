#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <catch2/catch.hpp>

#include "polygonize/polygonize.h"
#include "tests/support/analytic_fields.h"
#include "tests/support/lattice_field.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

void check_by_cgal(const Mesh& mesh) {
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const glm::vec3& p : mesh.positions) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
  for (const auto& t : mesh.triangles) {
    // CGAL refuses a face that would make an edge or a vertex non-manifold.
    REQUIRE(surface.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) != Surface::null_face());
  }
  CHECK(CGAL::is_closed(surface));
  CHECK(CGAL::is_valid_polygon_mesh(surface));
  CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(surface));
  CHECK(CGAL::Polygon_mesh_processing::is_outward_oriented(surface));
}

PolygonizeOptions cells_of(double size) {
  PolygonizeOptions options;
  options.cell_size = size;
  return options;
}

}  // namespace

TEST_CASE("CGAL finds meshes closed, oriented and free of self-intersections") {
  check_by_cgal(polygonize(ball_field(Vec3(0.1), 1), cells_of(0.1)));
  check_by_cgal(polygonize(torus_field(Vec3(0.1), 1, 0.3), cells_of(0.08)));
  check_by_cgal(polygonize(blobs_field(3, 12, 0.12), cells_of(0.03)));
  check_by_cgal(polygonize(ball_field(Vec3(1e5, 0, -1e5), 1), cells_of(0.2)));
}

TEST_CASE("CGAL finds no self-intersection in random patterns") {
  LatticeField field(glm::ivec3(26));
  for (int z = 1; z < 25; ++z) {
    for (int y = 1; y < 25; ++y) {
      for (int x = 1; x < 25; ++x) {
        const double u = random_unit(x, y, z);
        field.at({x, y, z}) = static_cast<float>(u < 0.2 ? 0.5 : u < 0.4 ? 0.499999 : u);
      }
    }
  }
  check_by_cgal(polygonize(field, cells_of(1)));
}
