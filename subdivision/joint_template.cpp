#include "subdivision/joint_template.h"

#include <limits>

#include <glm/geometric.hpp>

namespace barkridge {

namespace {

using Positions = std::vector<glm::vec3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Up to as many vertices as fit in a template's part.
struct Row {
  std::array<std::uint32_t, 6> vertices{};
  int count = 0;

  void add(std::uint32_t vertex) { vertices[static_cast<std::size_t>(count++)] = vertex; }
  std::uint32_t operator[](int i) const { return vertices[static_cast<std::size_t>(i)]; }
};

// Half a ring from front to back, on the side of the next branch or of the one before.
Row half(const JointRing& ring, bool next_side) {
  const auto& v = ring.vertices;
  if (ring.edge_forward) return next_side ? Row{{v[0], v[1], v[2]}, 3} : Row{{v[5], v[4], v[3]}, 3};
  return next_side ? Row{{v[0], v[1], v[2], v[3]}, 4} : Row{{v[0], v[5], v[4], v[3]}, 4};
}

double length(const Positions& positions, std::uint32_t a, std::uint32_t b) {
  return glm::distance(Vec3(positions[a]), Vec3(positions[b]));
}

// What the other choice must be shorter by, so that rounding does not choose between mirror images.
constexpr double kPreference = 1e-3;

// The strip between two half rings whose diagonals are shortest in sum; of equal ones those that mirror front and back.
// The first row is on the left, seen from outside with the front upward.
void add_strip(const Row& left, const Row& right, const Positions& positions, Triangles& triangles) {
  // best[i][j]: sum of lengths of the edges from (0, 0) to (i, j), each between left[i] and right[j].
  std::array<std::array<double, 4>, 4> best{};
  std::array<std::array<bool, 4>, 4> came_down_left{};
  const int middle = left.count + right.count - 2;
  for (int i = 0; i < left.count; ++i) {
    for (int j = 0; j < right.count; ++j) {
      if (i == 0 && j == 0) continue;
      constexpr double kNever = std::numeric_limits<double>::infinity();
      const double by_left = i > 0 ? best[i - 1][j] : kNever, by_right = j > 0 ? best[i][j - 1] : kNever;
      // A diagonal whose left end is lower is preferred in the front half, its mirror image in the back half.
      const int leaning = (i - j) * (2 * (i + j) <= middle ? 1 : -1);
      const double here = length(positions, left[i], right[j]) * (1 - kPreference * leaning);
      came_down_left[i][j] = by_left <= by_right;
      best[i][j] = std::min(by_left, by_right) + here;
    }
  }
  for (int i = left.count - 1, j = right.count - 1; i + j > 0;) {
    if (came_down_left[i][j]) {
      triangles.push_back({left[i - 1], left[i], right[j]});
      --i;
    } else {
      triangles.push_back({right[j - 1], left[i], right[j]});
      --j;
    }
  }
}

// Triangulates a polygon, counter-clockwise around the normal, by the diagonals that are shortest in sum among those
// that fold nothing over, if there are any.
void add_polygon(const Row& polygon, const Positions& positions, const Vec3& normal, bool flipped,
                 Triangles& triangles) {
  const int n = polygon.count;
  double perimeter = 0;
  for (int i = 0; i < n; ++i) perimeter += length(positions, polygon[i], polygon[(i + 1) % n]);
  const auto fold = [&](int i, int j, int k) {
    const Vec3 a(positions[polygon[i]]), b(positions[polygon[j]]), c(positions[polygon[k]]);
    return glm::dot(glm::cross(b - a, c - a), normal) <= 0 ? perimeter : 0.0;
  };
  // cost[i][k] of the part from i to k, cut off by the line between them; apex[i][k] makes a triangle with that line.
  std::array<std::array<double, 6>, 6> cost{};
  std::array<std::array<int, 6>, 6> apex{};
  for (int span = 2; span < n; ++span) {
    for (int i = 0, k = span; k < n; ++i, ++k) {
      double least = std::numeric_limits<double>::infinity();
      for (int j = i + 1; j < k; ++j) {
        const double sum = cost[i][j] + cost[j][k] + fold(i, j, k);
        if (sum >= least * (1 - kPreference)) continue;
        least = sum;
        apex[i][k] = j;
      }
      cost[i][k] = least + length(positions, polygon[i], polygon[k]);
    }
  }
  std::array<std::array<int, 2>, 6> parts{{{0, n - 1}}};
  for (int open = n > 2 ? 1 : 0; open > 0;) {
    const auto [i, k] = parts[--open];
    const int j = apex[i][k];
    const std::uint32_t a = polygon[i], b = polygon[j], c = polygon[k];
    triangles.push_back(flipped ? std::array{a, c, b} : std::array{a, b, c});
    if (j - i > 1) parts[open++] = {i, j};
    if (k - j > 1) parts[open++] = {j, k};
  }
}

// A ring's corners at the front or back, counter-clockwise around the normal: one or, edge-forward, two.
Row facing(const JointRing& ring, bool back) {
  const auto& v = ring.vertices;
  if (ring.edge_forward) return back ? Row{{v[3], v[2]}, 2} : Row{{v[5], v[0]}, 2};
  return back ? Row{{v[3]}, 1} : Row{{v[0]}, 1};
}

// All bottoms of one side. Edges of the three rings around the centre belong to the centre; farther out a bottom takes
// the edge of its outer branch.
void add_bottoms(std::span<const JointRing> rings, const Positions& positions, const Vec3& normal, bool back,
                 Triangles& triangles) {
  const Row carrier = facing(rings[0], back);
  const std::size_t bottoms = rings.size() - 2, centre = (bottoms + 1) / 2;
  for (std::size_t bottom = 1; bottom <= bottoms; ++bottom) {
    const Row right = facing(rings[bottom], back), left = facing(rings[bottom + 1], back);
    Row polygon;
    for (int i = bottom < centre ? carrier.count - 1 : 0; i < (bottom > centre ? 1 : carrier.count); ++i) {
      polygon.add(carrier[i]);
    }
    for (int i = bottom > centre ? right.count - 1 : 0; i < right.count; ++i) polygon.add(right[i]);
    for (int i = 0; i < (bottom < centre ? 1 : left.count); ++i) polygon.add(left[i]);
    add_polygon(polygon, positions, normal, back, triangles);
  }
}

}  // namespace

void triangulate_joint(std::span<const JointRing> rings, const Positions& positions, const Vec3& normal,
                       Triangles& triangles) {
  for (std::size_t i = 0; i < rings.size(); ++i) {
    add_strip(half(rings[i], true), half(rings[(i + 1) % rings.size()], false), positions, triangles);
  }
  add_bottoms(rings, positions, normal, false, triangles);
  add_bottoms(rings, positions, normal, true, triangles);
}

}  // namespace barkridge
