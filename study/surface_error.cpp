#include "study/surface_error.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <optional>

#include "base/random.h"

namespace barkridge {

namespace {

enum class Purpose { kInternode, kFork, kAlong, kAround };

double random_of(Purpose purpose, int window) { return random_unit(1, static_cast<int>(purpose), window); }

Box window_at(const Internode& internode, double along, double turn, double side) {
  const Vec3 axis = internode.tip - internode.base;
  Vec3 u, v;
  complete_frame(glm::normalize(axis), u, v);
  const double radius = internode.base_radius + along * (internode.tip_radius - internode.base_radius);
  const Vec3 center = internode.base + along * axis + radius * (std::cos(turn) * u + std::sin(turn) * v);
  return grown({center, center}, 0.5 * std::min(side, 6 * radius));
}

std::vector<InternodeId> forks_of(const Skeleton& skeleton) {
  const ChildTable table = child_table(skeleton);
  std::vector<InternodeId> forks;
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    if (table.first[i + 1] - table.first[i] > 1) forks.push_back(static_cast<InternodeId>(i));
  }
  return forks;
}

// Of the triangles that reach into a box, the points that lie in it: corners, middles of edges and of the whole.
std::vector<Vec3> points_within(const Mesh& mesh, const Box& box) {
  std::vector<Vec3> points;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]), c(mesh.positions[triangle[2]]);
    if (!Box{glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)}.overlaps(box)) continue;
    for (const Vec3& p : {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0}) {
      if (box.contains(p)) points.push_back(p);
    }
  }
  return points;
}

// The triangles that lie in a box.
Mesh part_within(const Mesh& mesh, const Box& box) {
  Mesh part;
  part.positions = mesh.positions;
  const auto is_within = [&](std::uint32_t vertex) { return box.contains(Vec3(mesh.positions[vertex])); };
  for (const auto& triangle : mesh.triangles) {
    if (std::all_of(triangle.begin(), triangle.end(), is_within)) part.triangles.push_back(triangle);
  }
  return part;
}

}  // namespace

std::vector<Box> error_windows(const Skeleton& skeleton, double side, int count) {
  std::vector<double> lengths;  // added up
  for (const Internode& internode : skeleton.internodes) {
    lengths.push_back((lengths.empty() ? 0 : lengths.back()) + glm::length(internode.tip - internode.base));
  }
  const std::vector<InternodeId> forks = forks_of(skeleton);
  std::vector<Box> windows;
  for (int i = 0; i < count && !lengths.empty(); ++i) {
    const double turn = 2 * std::numbers::pi * random_of(Purpose::kAround, i);
    if (i % 2 == 0 && !forks.empty()) {
      const auto fork = static_cast<std::size_t>(random_of(Purpose::kFork, i) * static_cast<double>(forks.size()));
      windows.push_back(window_at(skeleton.internodes[static_cast<std::size_t>(forks[fork])], 1, turn, side));
      continue;
    }
    const double place = random_of(Purpose::kInternode, i) * lengths.back();
    const auto found = std::upper_bound(lengths.begin(), lengths.end() - 1, place) - lengths.begin();
    windows.push_back(
        window_at(skeleton.internodes[static_cast<std::size_t>(found)], random_of(Purpose::kAlong, i), turn, side));
  }
  return windows;
}

std::vector<DistanceSummary> surface_errors(std::span<const Mesh> meshes, const std::vector<Box>& windows, double reach,
                                            const FineSurface& fine) {
  std::vector<DistanceSummary> errors(meshes.size());
  std::vector<std::optional<NearestPoint>> to_meshes(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!meshes[i].triangles.empty()) to_meshes[i].emplace(meshes[i]);
  }
  for (const Box& window : windows) {
    const Mesh around = part_within(fine(grown(window, reach)), grown(window, reach));
    if (around.triangles.empty()) continue;
    const NearestPoint to_fine(around);
    const std::vector<Vec3> points = points_within(around, window);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      if (!to_meshes[i]) continue;
      errors[i] = unite(errors[i], distances(points, *to_meshes[i]));
      errors[i] = unite(errors[i], distances(points_within(meshes[i], window), to_fine));
    }
  }
  return errors;
}

}  // namespace barkridge
