#pragma once
// Skeletons with known shapes, for tests.

#include <cmath>
#include <vector>

#include "lsystem/skeleton.h"
#include "tests/support/degree.h"
#include "tests/support/random_source.h"

namespace barkridge::test {

/// A trunk of unit radius that ends at the origin, coming from below, with branches of constant radius from there.
struct Branch {
  double angle_degrees;    ///< to the trunk's axis, y
  double azimuth_degrees;  ///< about it, from x towards z
  double radius;
};
inline Skeleton junction(const std::vector<Branch>& branches, double length = 10) {
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0, -length, 0), Vec3(0), 1, 1});
  for (const Branch& branch : branches) {
    const double a = branch.angle_degrees * kDegree, b = branch.azimuth_degrees * kDegree;
    const Vec3 direction(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
    skeleton.internodes.push_back({Vec3(0), length * direction, branch.radius, branch.radius, 0, 1});
  }
  return skeleton;
}

/// `count` equal branches around the axis whose cross-sections add up to the trunk's.
inline Skeleton fork(int count, double angle_degrees) {
  std::vector<Branch> branches;
  for (int i = 0; i < count; ++i) branches.push_back({angle_degrees, 360.0 * i / count, std::sqrt(1.0 / count)});
  return junction(branches);
}

/// An axis along y in internodes of one length, from radius 1 at y = 0, thinner by `taper` a length.
inline Skeleton chain(double internode_length, double total_length, double taper) {
  Skeleton skeleton;
  InternodeId parent = kNoInternode;
  for (double y = 0; y < total_length; y += internode_length) {
    const double top = y + internode_length;
    skeleton.internodes.push_back({Vec3(0, y, 0), Vec3(0, top, 0), 1 - taper * y, 1 - taper * top, parent});
    parent = static_cast<InternodeId>(skeleton.internodes.size()) - 1;
  }
  return skeleton;
}

/// A random tree of about unit size whose radii obey da Vinci's rule at every fork. `internodes` >= 1.
inline Skeleton random_skeleton(std::uint64_t seed, int internodes) {
  RandomSource random(seed);
  Skeleton skeleton;
  struct Tip {
    InternodeId parent;
    Vec3 position, direction;
    double radius, length;
    int order;
  };
  std::vector<Tip> tips{
      {kNoInternode, Vec3(0), Vec3(0, 1, 0), random.uniform(0.03, 0.06), random.uniform(0.15, 0.4), 0}};
  for (std::size_t next = 0; next < tips.size() && static_cast<int>(skeleton.internodes.size()) < internodes; ++next) {
    const Tip tip = tips[next];
    const int children = random.chance(0.5) ? 1 : random.integer(2, 4);
    // Shares of the cross-section: a leader and laterals.
    std::vector<double> shares;
    double sum = 0;
    for (int k = 0; k < children; ++k) sum += shares.emplace_back(random.uniform(0.1, 1));
    const Vec3 end = tip.position + tip.length * tip.direction;
    double thickest = 0;
    for (double& share : shares) thickest = std::max(thickest, share = tip.radius * std::sqrt(share / sum));
    const auto id = static_cast<InternodeId>(skeleton.internodes.size());
    skeleton.internodes.push_back({tip.position, end, tip.radius, tip.radius, tip.parent, tip.order});
    for (const double radius : shares) {
      const double turn = radius == thickest ? random.uniform(0, 25) : random.uniform(25, 85);
      const Vec3 side = glm::normalize(glm::cross(tip.direction, random.direction()));
      const Vec3 direction = glm::normalize(std::cos(turn * kDegree) * tip.direction + std::sin(turn * kDegree) * side);
      tips.push_back({id, end, direction, radius, tip.length * random.uniform(0.7, 0.95),
                      tip.order + (radius == thickest ? 0 : 1)});
    }
  }
  return skeleton;
}

/// A random tree in which the branches at every joint, up to five, lie in a plane with the internode that carries them,
/// each joint in a plane of its own, with 20 degrees or more between neighbours. `internodes` >= 1.
inline Skeleton random_planar_skeleton(std::uint64_t seed, int internodes) {
  RandomSource random(seed);
  Skeleton skeleton;
  struct Tip {
    InternodeId parent;
    Vec3 position, direction;
    double radius;
  };
  std::vector<Tip> tips{{kNoInternode, random.direction(), random.direction(), random.uniform(0.05, 0.2)}};
  for (std::size_t next = 0; next < tips.size() && static_cast<int>(skeleton.internodes.size()) < internodes; ++next) {
    const Tip tip = tips[next];
    const Vec3 end = tip.position + random.uniform(0.2, 2) * tip.direction;
    const auto id = static_cast<InternodeId>(skeleton.internodes.size());
    const double end_radius = tip.radius * random.uniform(0.8, 1);
    skeleton.internodes.push_back({tip.position, end, tip.radius, end_radius, tip.parent, 0, random.integer(0, 9)});
    const int children = random.chance(0.4) ? 1 : random.integer(2, 5);
    const Vec3 side = glm::normalize(glm::cross(tip.direction, random.direction()));
    double angle = random.uniform(-100, -60);
    for (int k = 0; k < children; ++k) {
      const double turn = children == 1 ? random.uniform(-30, 30) : angle;
      angle += random.uniform(20, 180.0 / children);
      const Vec3 direction = std::cos(turn * kDegree) * tip.direction + std::sin(turn * kDegree) * side;
      tips.push_back({id, end, glm::normalize(direction), end_radius * random.uniform(0.15, 1)});
    }
  }
  return skeleton;
}

}  // namespace barkridge::test
