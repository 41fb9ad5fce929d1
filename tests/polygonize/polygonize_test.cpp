#include "polygonize/polygonize.h"

#include <tbb/global_control.h>

#include <atomic>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "tests/support/analytic_fields.h"
#include "tests/support/lattice_field.h"
#include "tests/support/mesh_checks.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

constexpr double kPi = 3.14159265358979323846;

PolygonizeOptions cells_of(double size) {
  PolygonizeOptions options;
  options.cell_size = size;
  return options;
}

// Polygonizes, and checks all that holds for every field.
Mesh checked(const AnalyticField& field, double cell_size) {
  const Mesh mesh = polygonize(field, cells_of(cell_size));
  require_closed_manifold(mesh);
  CHECK(field.counts().outside_restriction == 0);
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  for (const glm::vec3& n : mesh.normals) {
    if (std::abs(glm::length(n) - 1) > 1e-5f) FAIL("a normal of length " << glm::length(n));
  }
  return mesh;
}

Mesh checked(const LatticeField& field) {
  PolygonizeOptions options = cells_of(1);
  options.close_creases = false;  // signs alone decide
  const Mesh mesh = polygonize(field, options);
  require_closed_manifold(mesh);
  return mesh;
}

std::size_t sign_changes(const LatticeField& field) {
  std::size_t changes = 0;
  const glm::ivec3 size = field.size();
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const bool inside = field.at({x, y, z}) >= 0.5f;
        changes += x + 1 < size.x && inside != (field.at({x + 1, y, z}) >= 0.5f);
        changes += y + 1 < size.y && inside != (field.at({x, y + 1, z}) >= 0.5f);
        changes += z + 1 < size.z && inside != (field.at({x, y, z + 1}) >= 0.5f);
      }
    }
  }
  return changes;
}

bool equal(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.triangles == b.triangles;
}

}  // namespace

TEST_CASE("a ball becomes one closed sphere") {
  const AnalyticField field = ball_field({0.3, -0.2, 0.1}, 1);
  const Mesh mesh = checked(field, 0.1);
  const MeshReport report = examine(mesh);
  CHECK(report.components == 1);
  CHECK(report.genus == 0);
  CHECK(report.volume == Approx(4 * kPi / 3).epsilon(0.01));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 from_center = Vec3(mesh.positions[i]) - Vec3(0.3, -0.2, 0.1);
    // On the sphere, but for those that are kept 1e-3 of a cell away from lattice points.
    CHECK(glm::length(from_center) == Approx(1).margin(1.1e-4));
    CHECK(glm::dot(glm::normalize(from_center), Vec3(mesh.normals[i])) == Approx(1).margin(1e-6));
  }
}

TEST_CASE("volume and area of a ball converge at second order") {
  const AnalyticField field = ball_field({0.013, 0.017, 0.011}, 1);
  std::vector<double> volume_errors, area_errors;
  for (const double h : {0.2, 0.1, 0.05}) {
    const MeshReport report = examine(checked(field, h));
    volume_errors.push_back(4 * kPi / 3 - report.volume);
    area_errors.push_back(4 * kPi - report.area);
  }
  for (std::size_t i = 1; i < volume_errors.size(); ++i) {
    CHECK(volume_errors[i - 1] / volume_errors[i] == Approx(4).epsilon(0.1));
    CHECK(area_errors[i - 1] / area_errors[i] == Approx(4).epsilon(0.1));
  }
}

TEST_CASE("a torus has one handle") {
  const MeshReport report = examine(checked(torus_field({0.05, 0.02, -0.07}, 1, 0.3), 0.05));
  CHECK(report.components == 1);
  CHECK(report.genus == 1);
  CHECK(report.volume == Approx(2 * kPi * kPi * 0.09).epsilon(0.02));
}

TEST_CASE("balls apart are pieces apart") {
  const Function two = union_of({ball({-2, 0, 0}, 0.7), ball({3, 1, 0}, 0.4)});
  const MeshReport report = examine(checked(solid(two, {{-3, -2, -2}, {4, 2, 2}}), 0.07));
  CHECK(report.components == 2);
  CHECK(report.genus == 0);
}

TEST_CASE("a hollow ball has an inner sphere facing inwards") {
  const Function shell = intersection_of({ball(Vec3(0), 1), complement_of(ball(Vec3(0), 0.5))});
  const MeshReport report = examine(checked(solid(shell, cube(Vec3(0), 1), 0.1), 0.05));
  CHECK(report.components == 2);
  CHECK(report.volume == Approx(4 * kPi / 3 * (1 - 0.125)).epsilon(0.01));
}

TEST_CASE("solids with creases stay closed") {
  const Function lens = intersection_of({ball({-0.6, 0, 0}, 1), ball({0.6, 0.1, 0}, 1)});
  CHECK(examine(checked(solid(lens, cube(Vec3(0), 1)), 0.06)).genus == 0);
  const Function cut = intersection_of({ball(Vec3(0), 1), half_space(glm::normalize(Vec3(1, 2, 3)), 0.2)});
  CHECK(examine(checked(solid(cut, cube(Vec3(0), 1)), 0.06)).genus == 0);
  const Function drilled = intersection_of({block(cube(Vec3(0.03), 1)), complement_of(torus(Vec3(0), 0.6, 0.2))});
  CHECK(examine(checked(solid(drilled, cube(Vec3(0.03), 1), 0.1), 0.07)).components == 2);
}

TEST_CASE("a block in line with the lattice has its exact volume") {
  // The faces lie on lattice planes: every lattice point of them has exactly the iso-value and is inside.
  const MeshReport report =
      examine(checked(solid(block({Vec3(-1), Vec3(0.5, 1, 2)}), {Vec3(-1), Vec3(0.5, 1, 2)}), 0.25));
  CHECK(report.components == 1);
  CHECK(report.genus == 0);
  CHECK(report.volume == Approx(9).epsilon(0.02));
}

TEST_CASE("a surface through many blocks is closed") {
  const Function maze = intersection_of({gyroid(1, 0.05), ball(Vec3(0.1), 2)});
  const MeshReport report = examine(checked(solid(maze, cube(Vec3(0.1), 2), 0.05), 0.04));
  CHECK(report.genus.value() > 10);
  CHECK(report.triangles > 100000);
}

TEST_CASE("random unions of soft balls become closed manifolds") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    const double cell_size = 0.02 + 0.05 * random_unit(seed, 77);
    const MeshReport report = examine(checked(blobs_field(seed, 12, 0.12), cell_size));
    CHECK(report.volume > 0);
  }
}

TEST_CASE("things thinner than a cell are cut up but closed") {
  const Function needle = intersection_of({torus(Vec3(0.01), 1, 0.02), half_space({0.6, 0.64, 0.48}, 0.3)});
  PolygonizeOptions options = cells_of(0.05);
  options.close_creases = false;
  const AnalyticField field = solid(needle, cube(Vec3(0), 1.1), 0.02);
  CHECK(require_closed_manifold(polygonize(field, options)).components > 10);
}

TEST_CASE("every pattern of inside and outside around two neighbouring cells is closed and manifold") {
  // The 12 corners of two cells in a row, along each axis, in a place of its own with outside points around.
  constexpr int kSide = 24;
  for (int axis = 0; axis < 3; ++axis) {
    LatticeField field(glm::ivec3(5 * kSide));
    for (int pattern = 0; pattern < 4096; ++pattern) {
      const glm::ivec3 at = 5 * glm::ivec3(pattern % kSide, pattern / kSide % kSide, pattern / kSide / kSide) + 1;
      for (int corner = 0; corner < 12; ++corner) {
        glm::ivec3 offset(0);
        offset[axis] = corner / 4;
        offset[(axis + 1) % 3] = corner & 1;
        offset[(axis + 2) % 3] = corner >> 1 & 1;
        if ((pattern >> corner & 1) != 0) field.at(at + offset) = 0.9f;
      }
    }
    CHECK(checked(field).positions.size() == sign_changes(field));
  }
}

TEST_CASE("random patterns of inside and outside are closed and manifold") {
  for (const double density : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    LatticeField field(glm::ivec3(62, 59, 67));
    const glm::ivec3 size = field.size();
    for (int z = 1; z < size.z - 1; ++z) {
      for (int y = 1; y < size.y - 1; ++y) {
        for (int x = 1; x < size.x - 1; ++x) {
          const bool inside = random_unit(x, y, z, 1) < density;
          const double depth = random_unit(x, y, z, 2);
          // Some exactly at the iso-value, others only just on one side of it.
          const double away = depth < 0.1 ? 0 : depth < 0.3 ? 1e-6 : 0.5 * depth;
          field.at({x, y, z}) = static_cast<float>(inside ? 0.5 + away : 0.4999 - 0.9 * away);
        }
      }
    }
    CAPTURE(density);
    const Mesh mesh = checked(field);
    CHECK(mesh.positions.size() == sign_changes(field));
    CHECK(examine(mesh).volume > 0);
  }
}

TEST_CASE("a sheet on which the field is exactly the iso-value does not appear") {
  // As where two parts are pressed together: inside the ball the field falls to the iso-value on the plane x = 0.
  const Function outer = ball(Vec3(0), 1);
  const AnalyticField field(cube(Vec3(0), 1.3), 2.5, [=](const Vec3& p) {
    const ValueAndGradient d = outer(p);
    if (d.value > 0) return ValueAndGradient{0.5 - 2 * d.value, -2.0 * d.gradient};
    if (std::abs(p.x) < -d.value) return ValueAndGradient{0.5 + std::abs(p.x), Vec3(p.x < 0 ? -1 : 1, 0, 0)};
    return ValueAndGradient{0.5 - d.value, -d.gradient};
  });
  const Mesh mesh = checked(field, 0.125);
  const MeshReport report = examine(mesh);
  CHECK(report.components == 1);
  CHECK(report.genus == 0);
  CHECK(report.volume == Approx(4 * kPi / 3).epsilon(0.02));
  for (const glm::vec3& p : mesh.positions) CHECK(glm::length(p) == Approx(1).margin(2e-4));
}

TEST_CASE("a solid that touches the iso-value in lattice points only") {
  // Single points and a line of exactly the iso-value are inside, as small as vertices may come.
  LatticeField field(glm::ivec3(20, 12, 12));
  field.at({4, 4, 4}) = 0.5f;
  field.at({8, 8, 8}) = 0.5f;  // where eight blocks meet
  for (int x = 11; x < 18; ++x) field.at({x, 4, 4}) = 0.5f;
  const Mesh mesh = checked(field);
  const MeshReport report = examine(mesh);
  CHECK(report.components == 3);
  CHECK(report.genus == 0);
  CHECK(report.volume > 0);
  CHECK(report.volume < 1e-4);
}

TEST_CASE("where the field has no gradient, normals come from the triangles") {
  const Function distance = ball(Vec3(0), 1);
  const AnalyticField field(cube(Vec3(0), 1.9), 3, [=](const Vec3& p) {
    const double d = distance(p).value;
    return ValueAndGradient{0.5 - d * d * d, Vec3(0)};
  });
  const Mesh mesh = checked(field, 0.1);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    CHECK(glm::dot(mesh.positions[i], mesh.normals[i]) > 0.9f);
    CHECK(glm::length(mesh.positions[i]) == Approx(1).margin(2e-4));
  }
}

TEST_CASE("nothing comes of nothing") {
  const AnalyticField nothing({}, 0, [](const Vec3&) { return ValueAndGradient{}; });
  CHECK(polygonize(nothing, cells_of(1)).triangles.empty());
  const AnalyticField faint(cube(Vec3(0), 1), 1, [](const Vec3&) { return ValueAndGradient{0.4, Vec3(0)}; });
  const Mesh mesh = polygonize(faint, cells_of(0.1));
  CHECK(mesh.positions.empty());
  CHECK(mesh.triangles.empty());
  CHECK(examine(polygonize(ball_field(Vec3(0.5), 0.1), cells_of(1))).triangles == 0);
}

TEST_CASE("the mesh does not depend on threads") {
  const Function maze = intersection_of({gyroid(1, 0.05), ball(Vec3(0.1), 1)});
  const AnalyticField field = solid(maze, cube(Vec3(0.1), 1), 0.05);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return polygonize(field, cells_of(0.03));
  };
  const Mesh one = with_threads(1);
  REQUIRE(one.triangles.size() > 10000);
  for (int i = 0; i < 3; ++i) CHECK(equal(one, with_threads(2)));
  CHECK(equal(one, with_threads(4)));
}

TEST_CASE("the mesh does not depend on how generous the support is") {
  const Mesh tight = polygonize(solid(ball(Vec3(0.2), 1), cube(Vec3(0.2), 1)), cells_of(0.09));
  const Mesh generous = polygonize(solid(ball(Vec3(0.2), 1), {Vec3(-3, -20, -1), Vec3(2, 2, 40)}), cells_of(0.09));
  CHECK(equal(tight, generous));
}

TEST_CASE("empty space is not sampled") {
  const AnalyticField field = solid(ball(Vec3(0.2), 1), cube(Vec3(0), 50));
  const Mesh mesh = polygonize(field, cells_of(0.05));
  // A dense lattice has 2000^3 points. The surface meets about 4 pi / 0.4^2 blocks' faces, a few times as many
  // blocks.
  CHECK(field.counts().evaluations < 729 * 400 + 8 * mesh.positions.size());
}

TEST_CASE("far from the origin, vertices stay apart") {
  for (const double distance : {1e3, 3e4, 1e5}) {
    CAPTURE(distance);
    const Vec3 center(distance, -distance, 0.3);
    const MeshReport report = examine(checked(ball_field(center, 1.5, 0.7), 0.25));
    CHECK(report.genus == 0);
    CHECK(report.volume == Approx(4 * kPi / 3 * 1.5 * 1.5 * 1.5).epsilon(0.05));
  }
}

TEST_CASE("a field whose bounds are wrong makes no broken mesh in silence") {
  class Liar : public AnalyticField {
   public:
    Liar() : AnalyticField(ball_field(Vec3(0), 1)) {}
    FieldBounds bounds(const Box& box) const override {
      return box.lo.x > 0 ? FieldBounds{} : AnalyticField::bounds(box);
    }
    std::shared_ptr<const Field> restricted(const Box&) const override { return std::make_shared<Liar>(); }
  };
  CHECK_THROWS_AS(polygonize(Liar(), cells_of(0.05)), std::logic_error);
}

TEST_CASE("cell sizes that cannot work are refused") {
  const AnalyticField field = ball_field({100, 0, 0}, 1);
  for (const double size : {0.0, -1.0, std::nan(""), double{INFINITY}}) {
    CHECK_THROWS_AS(polygonize(field, cells_of(size)), InputError);
  }
  CHECK_THROWS_WITH(polygonize(field, cells_of(1e-6)), Catch::Contains("1e-06") && Catch::Contains("32 bits"));
  const AnalyticField endless({Vec3(-INFINITY), Vec3(INFINITY)}, 1, [](const Vec3&) { return ValueAndGradient{}; });
  CHECK_THROWS_AS(polygonize(endless, cells_of(1)), InputError);
  CHECK(field.counts().evaluations == 0);
}

TEST_CASE("the limit on triangles holds exactly") {
  const AnalyticField field = ball_field(Vec3(0), 1);
  PolygonizeOptions options = cells_of(0.05);
  const std::size_t count = polygonize(field, options).triangles.size();
  options.max_triangles = count;
  CHECK(polygonize(field, options).triangles.size() == count);
  options.max_triangles = count - 1;
  CHECK_THROWS_AS(polygonize(field, options), LimitError);
}

TEST_CASE("progress rises to one, one call at a time, and can stop the work") {
  const AnalyticField field = ball_field(Vec3(0), 1);
  PolygonizeOptions options = cells_of(0.03);
  std::vector<double> fractions;
  std::atomic<int> calls_at_once = 0;
  bool rises_alone = true;
  options.progress = [&](double fraction) {
    rises_alone &= ++calls_at_once == 1 && (fractions.empty() || fraction >= fractions.back());
    fractions.push_back(fraction);
    --calls_at_once;
    return true;
  };
  polygonize(field, options);
  CHECK(rises_alone);
  CHECK(fractions.front() == 0);
  CHECK(fractions.back() == 1);
  CHECK(fractions.size() > 100);

  for (const double stop : {0.0, 0.5, 1.0}) {
    options.progress = [=](double fraction) { return fraction < stop; };
    CHECK_THROWS_AS(polygonize(field, options), Cancelled);
  }
}
