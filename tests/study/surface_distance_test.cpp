// Distances between surfaces whose distance is known.

#include "study/surface_distance.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"

using namespace barkridge;

namespace {

// A square in the plane y = height, in cells of two triangles, turned about y.
Mesh square(double height, int cells, double angle = 0) {
  Mesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = 2.0 * i / cells - 1, z = 2.0 * j / cells - 1;
      mesh.positions.emplace_back(std::cos(angle) * x - std::sin(angle) * z, height,
                                  std::sin(angle) * x + std::cos(angle) * z);
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

Mesh single(const Vec3& a, const Vec3& b, const Vec3& c) {
  Mesh mesh;
  mesh.positions = {glm::vec3(a), glm::vec3(b), glm::vec3(c)};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

}  // namespace

TEST_CASE("the nearest point of a triangle is found from all sides of it") {
  const NearestPoint triangle(single({0, 0, 0}, {2, 0, 0}, {0, 2, 0}));
  CHECK(triangle.distance({0.5, 0.5, 3}) == Approx(3));            // over its inside
  CHECK(triangle.distance({1, -2, 0}) == Approx(2));               // across an edge
  CHECK(triangle.distance({2, 2, 0}) == Approx(std::sqrt(2.0)));   // across the long edge
  CHECK(triangle.distance({-3, -4, 0}) == Approx(5));              // at a corner
  CHECK(triangle.distance({3, -1, 1}) == Approx(std::sqrt(3.0)));  // at another
  CHECK(triangle.distance({0.25, 0.25, 0}) == Approx(0).margin(1e-9));
}

TEST_CASE("a triangle without an area is as near as the line that it is") {
  const NearestPoint line(single({0, 0, 0}, {1, 0, 0}, {2, 0, 0}));
  CHECK(line.distance({1.5, 3, 4}) == Approx(5));
  CHECK(line.distance({5, 0, 4}) == Approx(5));
}

TEST_CASE("the nearest of many triangles is found as a search through all finds it") {
  Mesh heap;
  std::vector<NearestPoint> singles;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const auto corner = [&](int k) {
      return Vec3(random_unit(7, i, 3 * k), random_unit(7, i, 3 * k + 1), random_unit(7, i, 3 * k + 2));
    };
    const Vec3 a = corner(0), b = a + 0.2 * corner(1), c = a + 0.2 * corner(2);
    for (const Vec3& p : {a, b, c}) heap.positions.emplace_back(p);
    heap.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    singles.emplace_back(single(a, b, c));
  }
  const NearestPoint all(heap);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = 3.0 * Vec3(random_unit(8, i, 0), random_unit(8, i, 1), random_unit(8, i, 2)) - 1.0;
    double nearest = 1e9;
    for (const NearestPoint& one : singles) nearest = std::min(nearest, one.distance(p));
    CHECK(all.distance(p) == Approx(nearest).epsilon(1e-6).margin(1e-6));
  }
}

TEST_CASE("two parallel squares are as far apart as their planes, however they are cut into triangles") {
  const DistanceSummary apart = two_sided_distance(square(0, 7), square(0.25, 10));
  CHECK(apart.largest == Approx(0.25));
  CHECK(apart.root_mean_square() == Approx(0.25));
  const DistanceSummary same = two_sided_distance(square(0, 7), square(0, 10));
  CHECK(same.largest < 1e-6);
}

TEST_CASE("the distance is two-sided: what sticks out of one surface counts") {
  Mesh small = square(0, 4);
  for (auto& p : small.positions) p *= 0.5F;
  CHECK(two_sided_distance(small, square(0, 4)).largest == Approx(std::sqrt(0.5)).epsilon(1e-6));
  CHECK(two_sided_distance(square(0, 4), small).largest == Approx(std::sqrt(0.5)).epsilon(1e-6));
}

TEST_CASE("a tube of flat sides is off by the sagitta of their chords") {
  // Chords of n equal parts lie up to r (1 - cos(pi / n)) inside the circle.
  const auto tube = [](std::uint32_t n) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * i / n;
      mesh.positions.emplace_back(std::cos(angle), 0, std::sin(angle));
      mesh.positions.emplace_back(std::cos(angle), 1, std::sin(angle));
      const std::uint32_t a = 2 * i, b = (2 * i + 2) % (2 * n);
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({b, a + 1, b + 1});
    }
    return mesh;
  };
  const DistanceSummary apart = two_sided_distance(tube(12), tube(1200));
  CHECK(apart.largest == Approx(1 - std::cos(M_PI / 12)).epsilon(1e-3));
}

TEST_CASE("distances do not depend on threads") {
  const std::vector<Vec3> points = points_of(square(0.1, 20, 0.3));
  const NearestPoint to(square(0, 9));
  const DistanceSummary many = distances(points, to);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const DistanceSummary few = distances(points, to);
  CHECK(many.largest == few.largest);
  CHECK(many.mean_square == few.mean_square);
}
