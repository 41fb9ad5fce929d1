#pragma once
// Control meshes for tests: regular solids, sheets, tubes, and random surfaces with everything that a mesh may have.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "base/error.h"
#include "subdivision/control_mesh.h"
#include "tests/support/random_source.h"

namespace barkridge::test {

using Triangle = std::array<std::uint32_t, 3>;

inline ControlMesh octahedron() {
  ControlMesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

// `rows` x `columns` squares in the plane z = 0, corner to corner; ends of rows or columns joined where `around` says.
inline ControlMesh grid(std::uint32_t rows, std::uint32_t columns, bool rows_around = false,
                        bool columns_around = false) {
  ControlMesh mesh;
  const std::uint32_t height = rows + (rows_around ? 0 : 1), width = columns + (columns_around ? 0 : 1);
  for (std::uint32_t i = 0; i < height; ++i) {
    for (std::uint32_t j = 0; j < width; ++j) mesh.positions.emplace_back(j, i, 0);
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % height * width + j % width; };
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

inline ControlMesh torus(std::uint32_t rows = 7, std::uint32_t columns = 9) {
  ControlMesh mesh = grid(rows, columns, true, true);
  for (auto& p : mesh.positions) {
    const double u = 2 * std::numbers::pi * p.x / columns, v = 2 * std::numbers::pi * p.y / rows;
    const double r = 1 + 0.4 * std::cos(v);
    p = glm::vec3(glm::dvec3(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)));
  }
  return mesh;
}

// An open tube around the z axis with a seam of texture along it: u runs once around, v along.
inline ControlMesh tube(std::uint32_t rows, std::uint32_t sides) {
  ControlMesh mesh = grid(rows, sides, false, true);
  for (auto& p : mesh.positions) {
    const double angle = 2 * std::numbers::pi * p.x / sides;
    p = glm::vec3(glm::dvec3(std::cos(angle), std::sin(angle), p.y));
  }
  const ControlMesh flat = grid(rows, sides);
  for (const auto& p : flat.positions) {
    mesh.texture.emplace_back(p.x / static_cast<float>(sides), p.y / static_cast<float>(rows));
  }
  mesh.texture_triangles = flat.triangles;
  return mesh;
}

// Whether the mesh is a control mesh.
inline bool is_valid(const ControlMesh& mesh) {
  try {
    check(mesh);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// Turns edges of a closed or open surface at random where that leaves it a manifold: valences from 3 to some 12.
inline void flip_edges(ControlMesh& mesh, RandomSource& random, int times) {
  for (int i = 0; i < times; ++i) {
    std::map<std::array<std::uint32_t, 2>, std::array<std::uint32_t, 2>> corner;  // edge -> triangle, corner
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::uint32_t k = 0; k < 3; ++k) corner[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = {t, k};
    }
    auto one = std::next(corner.begin(), random.integer(0, static_cast<int>(corner.size()) - 1));
    const auto [a, b] = one->first;
    const auto two = corner.find({b, a});
    if (two == corner.end()) continue;
    const std::uint32_t c = mesh.triangles[one->second[0]][(one->second[1] + 2) % 3];
    const std::uint32_t d = mesh.triangles[two->second[0]][(two->second[1] + 2) % 3];
    if (c == d || corner.count({c, d}) || corner.count({d, c})) continue;
    mesh.triangles[one->second[0]] = {a, d, c};
    mesh.triangles[two->second[0]] = {d, b, c};
    if (!is_valid(mesh)) {
      mesh.triangles[one->second[0]] = {a, b, c};
      mesh.triangles[two->second[0]] = {b, a, d};
    }
  }
}

// Texture of two charts that meet at random edges, and of single triangles torn out.
inline void add_random_texture(ControlMesh& mesh, RandomSource& random) {
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < 2 * count; ++i) {
    mesh.texture.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1));
  }
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t chart = mesh.positions[t[0]].x + mesh.positions[t[1]].x > 0.1F ? count : 0;
    Triangle texture{t[0] + chart, t[1] + chart, t[2] + chart};
    if (random.chance(0.05)) {
      for (auto& index : texture) {
        index = static_cast<std::uint32_t>(mesh.texture.size());
        mesh.texture.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1));
      }
    }
    mesh.texture_triangles.push_back(texture);
  }
}

inline float random_sharpness(RandomSource& random) {
  return random.chance(0.4) ? kInfinitelySharp : static_cast<float>(random.uniform(0.1, 3.5));
}

// Removes triangles at random where the rest stays a mesh of whole fans without unused vertices.
inline void tear_holes(ControlMesh& mesh, RandomSource& random, int times) {
  for (int i = 0; i < times; ++i) {
    ControlMesh torn = mesh;
    torn.triangles.erase(torn.triangles.begin() + random.integer(0, static_cast<int>(torn.triangles.size()) - 1));
    std::vector<int> uses(torn.positions.size(), 0);
    for (const Triangle& t : torn.triangles) {
      for (const std::uint32_t v : t) ++uses[v];
    }
    if (std::find(uses.begin(), uses.end(), 0) == uses.end() && is_valid(torn)) mesh = torn;
  }
}

/// A random surface in the box from -1 to 1: closed or with holes, of many valences, with edges and vertices that are
/// sharp or semi-sharp, corners, and seams.
inline ControlMesh random_mesh(std::uint64_t seed) {
  RandomSource random(seed);
  ControlMesh mesh = random.chance(0.5) ? torus(5, 6) : grid(5, 6);
  for (auto& p : mesh.positions) p = glm::vec3(random.in_box({Vec3(-1), Vec3(1)}));
  flip_edges(mesh, random, 60);
  tear_holes(mesh, random, random.integer(0, 8));
  for (const Triangle& t : mesh.triangles) {
    if (random.chance(0.12)) mesh.sharp_edges.push_back({{t[0], t[1]}, random_sharpness(random)});
  }
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (random.chance(0.08)) mesh.sharp_vertices.push_back({v, random_sharpness(random)});
  }
  add_random_texture(mesh, random);
  return mesh;
}

}  // namespace barkridge::test
