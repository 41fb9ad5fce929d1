#include "subdivision/hull_trim.h"

#include <cmath>
#include <numbers>

namespace barkridge {

namespace {

// The part of a share of an angle that a cone leaves free, of the smaller share.
constexpr double kMargin = 0.2;
// Beyond a right angle from a branch's axis is only the flat end of its cylinder, which others may come near to.
constexpr double kMostShare = std::numbers::pi / 2;

// Exact also for angles near 0 and pi.
double angle_between(const Vec3& a, const Vec3& b) { return 2 * std::atan2(glm::length(a - b), glm::length(a + b)); }

// The share of their angle without which a branch's ring does not fit into its room.
double least_share(const HullBranch& branch) {
  return std::min(std::atan2(branch.radius, branch.room) / (1 - kMargin), kMostShare);
}

// The first branch's share of the angle `theta` to the second.
double share(const HullBranch& a, const HullBranch& b, double theta) {
  const double touching = std::atan2(a.radius * std::sin(theta), b.radius + a.radius * std::cos(theta));
  double least = least_share(a), most = theta - least_share(b);
  // A thinner branch would begin below the other's surface.
  if (a.radius < b.radius) least = std::min(least, touching);
  if (b.radius < a.radius) most = std::max(most, touching);
  // Without room for both, one of them will have to go.
  const double wanted = least <= most ? std::clamp(touching, least, most) : touching;
  return std::clamp(wanted, std::max(theta - kMostShare, 0.0), std::min(theta, kMostShare));
}

}  // namespace

std::vector<HullCone> hull_cones(std::span<const HullBranch> branches) {
  std::vector<HullCone> cones(branches.size(), {kWidestHullCone, std::numeric_limits<double>::infinity()});
  const auto for_pairs = [&](auto work) {
    for (std::size_t i = 0; i < branches.size(); ++i) {
      for (std::size_t j = i + 1; j < branches.size(); ++j) {
        work(i, j, angle_between(branches[i].direction, branches[j].direction));
      }
    }
  };
  for_pairs([&](std::size_t i, std::size_t j, double theta) {
    const double first = share(branches[i], branches[j], theta);
    const double second = theta - first;
    const double margin = kMargin * std::min(first, second);
    cones[i].angle = std::min(cones[i].angle, first - margin);
    cones[j].angle = std::min(cones[j].angle, second - margin);
  });
  for_pairs([&](std::size_t i, std::size_t j, double theta) {
    const double gap = theta - cones[i].angle - cones[j].angle;
    cones[i].gap = std::min(cones[i].gap, gap);
    cones[j].gap = std::min(cones[j].gap, gap);
  });
  return cones;
}

}  // namespace barkridge
