#include "polygonize/cell_cases.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <utility>

#include "base/geometry.h"
#include "base/random.h"

using namespace barkridge;

namespace {

using Triangle = std::array<std::uint8_t, 3>;

std::vector<Triangle> triangles_of(int cell_case) {
  const CellCase& c = kCellCases[static_cast<std::size_t>(cell_case)];
  return {c.triangles.begin(), c.triangles.begin() + c.triangle_count};
}

int upper_corner(int edge) { return edge_corner(edge) | 1 << edge_axis(edge); }

Vec3 corner_position(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2 & 1}; }

bool in_common_face(int a, int b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == edge_axis(a) || axis == edge_axis(b)) continue;
    if ((edge_corner(a) >> axis & 1) == (edge_corner(b) >> axis & 1)) return true;
  }
  return false;
}

// Sides of triangles that are not run along both ways within the cell: where the surface leaves it.
std::set<std::pair<int, int>> open_sides(int cell_case) {
  std::map<std::pair<int, int>, int> uses;
  for (const Triangle& t : triangles_of(cell_case)) {
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  std::set<std::pair<int, int>> open;
  for (const auto& [side, count] : uses) {
    CHECK(count == 1);
    if (uses.count({side.second, side.first}) == 0) open.insert(side);
  }
  return open;
}

double orient(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

// Whether the segment from p to q goes through the inside of a triangle.
bool pierces(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  constexpr double kTiny = 1e-14;
  if (orient(t[0], t[1], t[2], p) * orient(t[0], t[1], t[2], q) >= -kTiny * kTiny) return false;
  const std::array<double, 3> s{orient(p, q, t[0], t[1]), orient(p, q, t[1], t[2]), orient(p, q, t[2], t[0])};
  return std::all_of(s.begin(), s.end(), [](double x) { return x > kTiny; }) ||
         std::all_of(s.begin(), s.end(), [](double x) { return x < -kTiny; });
}

bool side_pierces(const Triangle& a, const Triangle& b, const std::array<Vec3, 12>& places) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto p = a[k], q = a[(k + 1) % 3];
    if (std::count(b.begin(), b.end(), p) + std::count(b.begin(), b.end(), q) > 0) continue;
    if (pierces(places[p], places[q], {places[b[0]], places[b[1]], places[b[2]]})) return true;
  }
  return false;
}

// A place for a vertex on every edge, often very close to an end.
std::array<Vec3, 12> random_places(std::uint64_t seed) {
  std::array<Vec3, 12> places;
  for (int edge = 0; edge < 12; ++edge) {
    const double unit = random_unit(seed, edge, 0);
    const double choice = random_unit(seed, edge, 1) + 0.5 * (static_cast<double>(seed % 3) - 1);
    const double t = choice < 0.4 ? unit : unit < 0.5 ? 1e-3 * (1 + unit) : 1 - 1e-3 * (1 + unit);
    places[static_cast<std::size_t>(edge)] =
        glm::mix(corner_position(edge_corner(edge)), corner_position(upper_corner(edge)), t);
  }
  return places;
}

}  // namespace

TEST_CASE("a cell has a vertex on exactly the edges that leave the solid") {
  for (int cell_case = 0; cell_case < 256; ++cell_case) {
    std::set<int> used;
    for (const Triangle& t : triangles_of(cell_case)) used.insert(t.begin(), t.end());
    for (int edge = 0; edge < 12; ++edge) {
      const bool crossed = (cell_case >> edge_corner(edge) & 1) != (cell_case >> upper_corner(edge) & 1);
      CHECK(crossed == (used.count(edge) == 1));
    }
  }
}

TEST_CASE("triangles lie in a face with no more than one side, and only where the surface leaves the cell") {
  for (int cell_case = 0; cell_case < 256; ++cell_case) {
    const auto open = open_sides(cell_case);
    for (const Triangle& t : triangles_of(cell_case)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        CHECK(in_common_face(a, b) == (open.count({a, b}) == 1));
      }
      CHECK_FALSE((in_common_face(t[0], t[1]) && in_common_face(t[1], t[2]) && in_common_face(t[2], t[0]) &&
                   edge_axis(t[0]) == edge_axis(t[1]) && edge_axis(t[1]) == edge_axis(t[2])));
    }
  }
}

TEST_CASE("any two neighbouring cells continue each other") {
  // The edges and corners of a face axis = 1 seen from the lower cell, and of axis = 0 seen from the upper one,
  // differ in the bit of that axis only.
  for (int axis = 0; axis < 3; ++axis) {
    const int bit = 1 << axis;
    const auto lower_edge = [&](int upper_edge) {
      for (int edge = 0; edge < 12; ++edge) {
        if (edge_axis(edge) == edge_axis(upper_edge) && edge_corner(edge) == (edge_corner(upper_edge) | bit)) {
          return edge;
        }
      }
      return -1;
    };
    // What leaves the upper cell through the face, in the lower cell's edges, for each upper case.
    std::map<int, std::set<std::pair<int, int>>> seen;  // by the face's corners
    for (int cell_case = 0; cell_case < 256; ++cell_case) {
      int face = 0;
      for (int corner = 0; corner < 8; ++corner) {
        if ((corner & bit) == 0) face |= (cell_case >> corner & 1) << corner;
      }
      std::set<std::pair<int, int>> sides;
      for (const auto& [a, b] : open_sides(cell_case)) {
        if (((edge_corner(a) | edge_corner(b)) & bit) == 0 && edge_axis(a) != axis && edge_axis(b) != axis) {
          sides.insert({lower_edge(b), lower_edge(a)});
        }
      }
      const auto [known, is_new] = seen.emplace(face, sides);
      CHECK(known->second == sides);
    }
    for (int cell_case = 0; cell_case < 256; ++cell_case) {
      int face = 0;
      for (int corner = 0; corner < 8; ++corner) {
        if ((corner & bit) == 0) face |= (cell_case >> (corner | bit) & 1) << corner;
      }
      std::set<std::pair<int, int>> sides;
      for (const auto& [a, b] : open_sides(cell_case)) {
        if ((edge_corner(a) & edge_corner(b) & bit) != 0) sides.insert({a, b});
      }
      CHECK(seen.at(face) == sides);
    }
  }
}

TEST_CASE("triangles face away from the inside corners") {
  for (int corner = 0; corner < 8; ++corner) {
    for (const bool inverted : {false, true}) {
      const auto triangles = triangles_of(inverted ? 255 ^ 1 << corner : 1 << corner);
      REQUIRE(triangles.size() == 1);
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = 0.5 * (corner_position(edge_corner(triangles[0][k])) + corner_position(upper_corner(triangles[0][k])));
      }
      const Vec3 away = inverted ? corner_position(corner) - p[0] : p[0] - corner_position(corner);
      CHECK(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), away) > 0);
    }
  }
}

TEST_CASE("triangles of a cell do not cross, wherever their vertices are on the edges") {
  std::size_t tested = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::array<Vec3, 12> places = random_places(seed);
    for (int cell_case = 0; cell_case < 256; ++cell_case) {
      const auto triangles = triangles_of(cell_case);
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = 0; j < triangles.size(); ++j) {
          if (i == j) continue;
          ++tested;
          if (side_pierces(triangles[i], triangles[j], places)) FAIL("case " << cell_case << " seed " << seed);
        }
      }
    }
  }
  CHECK(tested > 1000000);
}
