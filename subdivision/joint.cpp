#include "subdivision/joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "subdivision/frames.h"

namespace barkridge {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSameDirection = 1 * kDegree;

// Exact also for small angles, where the cosine has no digits left.
double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

void check_directions(std::span<const JointBranch> branches) {
  for (std::size_t j = 1; j < branches.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (angle_between(branches[i].direction, branches[j].direction) >= kSameDirection) continue;
      if (i == 0) {
        throw InputError(fmt::format("internode {} runs back along internode {}, which carries it",
                                     branches[j].internode, branches[i].internode));
      }
      throw InputError(fmt::format("internodes {} and {} leave a joint in the same direction", branches[i].internode,
                                   branches[j].internode));
    }
  }
}

// The eigenvector of the smallest eigenvalue of a symmetric matrix, by Jacobi rotations until nothing is left beside
// the diagonal: four sweeps or so.
Vec3 smallest_axis(Mat3 m) {
  Mat3 axes(1);
  const double nothing = 1e-17 * (m[0][0] + m[1][1] + m[2][2]);
  constexpr int kSweeps = 12;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(m[p][q]) <= nothing) continue;
        const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]);
        Mat3 turn(1);
        turn[p][p] = turn[q][q] = std::cos(angle);
        turn[q][p] = std::sin(angle);
        turn[p][q] = -turn[q][p];
        m = glm::transpose(turn) * m * turn;
        axes = axes * turn;
      }
    }
  }
  int smallest = 0;
  for (int i = 1; i < 3; ++i) smallest = m[i][i] < m[smallest][smallest] ? i : smallest;
  return glm::normalize(axes[smallest]);
}

}  // namespace

Vec3 branching_plane(std::span<const JointBranch> branches, double max_out_of_plane_degrees) {
  check_directions(branches);
  Mat3 spread(0);
  for (const JointBranch& branch : branches) spread += glm::outerProduct(branch.direction, branch.direction);
  Vec3 normal = smallest_axis(spread);
  int largest = 0;
  for (int i = 1; i < 3; ++i) largest = std::abs(normal[i]) > std::abs(normal[largest]) ? i : largest;
  if (normal[largest] < 0) normal = -normal;

  const JointBranch* worst = nullptr;
  double farthest = 0;
  for (const JointBranch& branch : branches) {
    const double out = std::asin(std::min(1.0, std::abs(glm::dot(branch.direction, normal)))) / kDegree;
    if (out <= farthest) continue;
    farthest = out;
    worst = &branch;
  }
  if (worst != nullptr && farthest > max_out_of_plane_degrees) {
    throw InputError(fmt::format(
        "internode {} leaves the plane of the branches at its joint by {:.1f} degrees: expected at most {:g}; joints "
        "whose branches lie in no common plane need the hull method",
        worst->internode, farthest, max_out_of_plane_degrees));
  }
  return normal;
}

std::vector<std::uint32_t> around(std::span<const JointBranch> branches, const Vec3& normal) {
  const Frame plane = frame_towards(normal, branches[0].direction);
  std::vector<double> angles;
  angles.reserve(branches.size());
  for (const JointBranch& branch : branches) {
    const double angle =
        std::atan2(glm::dot(branch.direction, plane.binormal()), glm::dot(branch.direction, plane.normal));
    angles.push_back(angle < 0 ? angle + 2 * std::numbers::pi : angle);
  }
  std::vector<std::uint32_t> order(branches.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin() + 1, order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return angles[a] < angles[b]; });
  return order;
}

double clearance(double radius, double other, double angle) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  if (other + radius * cosine <= 0) return 0;
  if (radius + other * cosine <= 0) return -radius * sine / cosine;
  return (other + radius * cosine) / sine;
}

std::vector<double> clearances(std::span<const JointBranch> branches) {
  std::vector<double> result(branches.size(), 0);
  for (std::size_t j = 1; j < branches.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const double angle = angle_between(branches[i].direction, branches[j].direction);
      result[i] = std::max(result[i], clearance(branches[i].radius, branches[j].radius, angle));
      result[j] = std::max(result[j], clearance(branches[j].radius, branches[i].radius, angle));
    }
  }
  return result;
}

}  // namespace barkridge
