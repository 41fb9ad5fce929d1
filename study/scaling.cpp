#include "study/scaling.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

#include "lsystem/skeleton.h"
#include "study/measurement.h"
#include "subdivision/hull.h"
#include "subdivision/loop.h"
#include "subdivision/template_mesh.h"

namespace barkridge {

namespace {

constexpr int kDegrees[] = {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 200};
constexpr std::size_t kMostTriangles = 2'000'000;

double median_seconds(int turns, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int turn = 0; turn < turns; ++turn) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return times_of(seconds).median;
}

// A stem that carries branches in the given directions, so thin that a joint has room for all.
Skeleton joint_of(const std::vector<Vec3>& directions) {
  const double radius = 0.5 / std::max<std::size_t>(2, directions.size());
  Skeleton skeleton;
  Internode stem;
  stem.base = {0, -1, 0};
  stem.base_radius = stem.tip_radius = radius;
  skeleton.internodes.push_back(stem);
  for (const Vec3& direction : directions) {
    Internode branch;
    branch.tip = direction;
    branch.base_radius = branch.tip_radius = radius;
    branch.parent = 0;
    branch.order = 1;
    skeleton.internodes.push_back(branch);
  }
  return skeleton;
}

// Spread over all of the sphere but the stem's cap.
std::vector<Vec3> on_sphere(int count) {
  std::vector<Vec3> directions;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double y = 1 - 1.8 * (i + 0.5) / count, r = std::sqrt(1 - y * y);
    directions.emplace_back(r * std::cos(turn * i), y, r * std::sin(turn * i));
  }
  return directions;
}

std::vector<Vec3> in_plane(int count) {
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double angle = 1.8 * std::numbers::pi * ((i + 0.5) / count - 0.5);
    directions.emplace_back(std::sin(angle), std::cos(angle), 0);
  }
  return directions;
}

}  // namespace

std::vector<PlotSeries> joint_times(int turns) {
  PlotSeries hull{"hull", {}}, templates{"templates", {}};
  for (const int degree : kDegrees) {
    const Skeleton round = joint_of(on_sphere(degree)), flat = joint_of(in_plane(degree));
    hull.points.emplace_back(degree, median_seconds(turns, [&] { hull_mesh(round); }));
    templates.points.emplace_back(degree, median_seconds(turns, [&] { template_mesh(flat); }));
  }
  return {hull, templates};
}

PlotSeries loop_times(int turns) {
  PlotSeries series{"one step", {}};
  ControlMesh mesh = hull_mesh(joint_of(on_sphere(3)));
  while (mesh.triangles.size() < kMostTriangles) {
    const auto triangles = static_cast<double>(mesh.triangles.size());
    series.points.emplace_back(triangles, median_seconds(turns, [&] { subdivide(mesh, 1); }));
    mesh = subdivide(mesh, 1);
  }
  return series;
}

}  // namespace barkridge
