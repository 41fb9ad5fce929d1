#pragma once
// What can go wrong with the surface of any tree, as numbers: radii around every internode's axis, found by rays.

#include <algorithm>
#include <cmath>
#include <vector>

#include "blobtree/field.h"
#include "blobtree/primitive.h"
#include "tests/support/skeletons.h"

namespace barkridge::test {

/// At 5 to 120 degrees to an axis and 25 or more to others, if some tries find such a one.
inline Vec3 wild_direction(RandomSource& random, const Vec3& axis, const std::vector<Vec3>& others) {
  constexpr int kTries = 50;
  Vec3 direction;
  for (int k = 0; k < kTries; ++k) {
    const double turn = random.uniform(5, 120) * kDegree;
    const Vec3 side = glm::normalize(glm::cross(axis, random.direction()));
    direction = glm::normalize(std::cos(turn) * axis + std::sin(turn) * side);
    const double most = std::cos(25 * kDegree);
    if (std::none_of(others.begin(), others.end(), [&](const Vec3& o) { return glm::dot(o, direction) > most; })) break;
  }
  return direction;
}

/// A tree that no gardener would plant: orders up to 1 to 5, 1 to 8 branches at a point, at 5 to 120 degrees to what
/// carries them and mostly 25 or more to each other, internodes from a fifth to ten of their radii long, radii by da
/// Vinci's rule with shares of 0.1 to 1.
/// Branches stop growing where there are `internodes` or a few more.
inline Skeleton wild_skeleton(std::uint64_t seed, int internodes = 30) {
  RandomSource random(seed ^ 0x9e3779b97f4a7c15ull);
  Skeleton skeleton;
  struct Tip {
    InternodeId parent;
    Vec3 position, direction;
    double radius;
    int order;
  };
  const int highest_order = random.integer(1, 5);
  const auto length_of = [&](double radius) { return radius * 0.2 * std::pow(50.0, random.unit()); };
  std::vector<Tip> tips{{kNoInternode, Vec3(0), Vec3(0, 1, 0), 1, 0}};
  for (std::size_t next = 0; next < tips.size(); ++next) {
    const Tip tip = tips[next];
    const Vec3 end = tip.position + length_of(tip.radius) * tip.direction;
    const double tip_radius = tip.radius * random.uniform(0.9, 1);
    const auto id = static_cast<InternodeId>(skeleton.internodes.size());
    skeleton.internodes.push_back({tip.position, end, tip.radius, tip_radius, tip.parent, tip.order});
    if (static_cast<int>(tips.size()) >= internodes) continue;
    const int children = tip.order == highest_order || random.chance(0.4) ? 1 : random.integer(2, 8);
    std::vector<double> shares;
    double sum = 0;
    for (int k = 0; k < children; ++k) sum += shares.emplace_back(random.uniform(0.1, 1));
    const double largest = *std::max_element(shares.begin(), shares.end());
    std::vector<Vec3> directions;
    for (const double share : shares) {
      directions.push_back(wild_direction(random, tip.direction, directions));
      tips.push_back(
          {id, end, directions.back(), tip_radius * std::sqrt(share / sum), tip.order + (share == largest ? 0 : 1)});
    }
  }
  return skeleton;
}

/// The worst anywhere on a tree, and where: the internode and the place along it, from 0 to 1.
struct Worst {
  double value = 0;
  std::size_t internode = 0;
  double along = 0;
  double azimuth = 0;
  void consider(double other, std::size_t i, double at, double turn) {
    if (other > value) *this = {other, i, at, turn};
  }
};

struct Dependability {
  /// How far the surface lies from the nearest axis beyond the thickest radius that meets there (at a junction within
  /// three of that along the tree, however many internodes that is, or the internode's own), in units of it, on sides
  /// where no other axis lies and none passes by.
  Worst swelling;
  /// How far half the solid's thickness, along a line across the axis, falls short of the internode's own radius, in
  /// units of that; up to a tenth of a radius before its fork. Away from forks and gentle turns, as for rings, it is
  /// the radius itself. The own radius is that of the internode by itself, the spheres along its axis, which where it
  /// tapers reach farther across than the sphere there.
  Worst necking;
  /// The same of the radius by itself: more than that where a corner is rounded. No defect.
  Worst rounding;
  /// How much the radius rises after a dip along an internode, in units of its own, on such sides and farther than
  /// three of the thickest radii from forks and tips. Where the axis turns by up to 30 degrees within three radii it is
  /// half the thickness, as for necks: a rounded corner lies beside its axis and is as thick. Where another internode
  /// by itself reaches the place, the surface is that one's, and rises as it does.
  Worst ring;
  /// Places on the axis that are outside of the solid.
  int missing = 0;

  bool holds() const { return swelling.value <= 0.05 && necking.value <= 0.05 && ring.value <= 0.01 && missing == 0; }
};

namespace dependability {

inline double distance_to(const Internode& a, const Vec3& p, Vec3& nearest) {
  const Vec3 axis = a.tip - a.base;
  nearest = a.base + std::clamp(glm::dot(p - a.base, axis) / glm::dot(axis, axis), 0.0, 1.0) * axis;
  return glm::distance(p, nearest);
}

// How far an internode's round cone, the spheres along it, reaches across from its axis, at a share of its length.
inline double reach_across(const Internode& a, double along) {
  const double length = glm::distance(a.base, a.tip);
  const double taper = (a.tip_radius - a.base_radius) / length;
  const double y = along * length, radius = a.base_radius + taper * y;
  const double flank = radius / std::sqrt(std::max(1e-9, 1 - taper * taper));
  const double center = y + taper * flank * flank / radius;  // of the sphere that reaches farthest
  if (0 <= center && center <= length) return flank;
  const double from_base = std::sqrt(std::max(0.0, a.base_radius * a.base_radius - y * y));
  const double from_tip = std::sqrt(std::max(0.0, a.tip_radius * a.tip_radius - (length - y) * (length - y)));
  return std::max(from_base, from_tip);
}

// Lengths of ways along a tree.
class Ways {
 public:
  explicit Ways(const Skeleton& skeleton) : all_(skeleton.internodes), starts_(all_.size()) {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const InternodeId parent = all_[i].parent;
      if (parent != kNoInternode) starts_[i] = end(static_cast<std::size_t>(parent));
    }
  }

  /// Between two places on axes.
  double between(std::size_t a, const Vec3& on_a, std::size_t b, const Vec3& on_b) const {
    const double from_root_a = starts_[a] + glm::distance(all_[a].base, on_a);
    const double from_root_b = starts_[b] + glm::distance(all_[b].base, on_b);
    // The later one's ancestors until both are the same.
    std::size_t x = a, y = b;
    while (x != y) {
      std::size_t& later = x > y ? x : y;
      if (all_[later].parent == kNoInternode) return from_root_a + from_root_b;
      later = static_cast<std::size_t>(all_[later].parent);
    }
    if (x == a || x == b) return std::abs(from_root_a - from_root_b);
    return from_root_a + from_root_b - 2 * end(x);
  }

 private:
  double end(std::size_t i) const { return starts_[i] + glm::distance(all_[i].base, all_[i].tip); }

  const std::vector<Internode>& all_;
  std::vector<double> starts_;  // way from the root to an internode's base
};

struct Ray {
  Vec3 origin, direction;
  double own, along, azimuth;
  bool away;   // from forks and tips
  bool bends;  // near a gentle corner
};

// Where the rays leave the solid for the first time, or `most`. Rays that start outside: 0.
inline std::vector<double> exits(const Field& field, const std::vector<Ray>& rays, double most) {
  constexpr int kSteps = 32, kHalvings = 12;
  std::vector<double> inside(rays.size(), 0), outside(rays.size(), -1), values(rays.size());
  std::vector<Vec3> points(rays.size());
  const auto look = [&](auto distance) {
    for (std::size_t i = 0; i < rays.size(); ++i) points[i] = rays[i].origin + distance(i) * rays[i].direction;
    field.values(points, values);
  };
  for (int step = 0; step <= kSteps; ++step) {
    const auto at = [&](std::size_t) { return most * step / kSteps; };
    look(at);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (outside[i] >= 0) continue;
      (values[i] >= kIsoValue ? inside : outside)[i] = at(i);
    }
  }
  for (int k = 0; k < kHalvings; ++k) {
    const auto middle = [&](std::size_t i) { return outside[i] < 0 ? inside[i] : 0.5 * (inside[i] + outside[i]); };
    look(middle);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (outside[i] < 0) continue;
      (values[i] >= kIsoValue ? inside : outside)[i] = middle(i);
    }
  }
  return inside;
}

}  // namespace dependability

inline Dependability dependability_of(const Skeleton& skeleton, const Field& field) {
  using namespace dependability;
  constexpr int kAlong = 24, kAround = 8;
  constexpr double kMost = 1.6;
  const auto& all = skeleton.internodes;
  const ChildTable table = child_table(skeleton);
  const auto children = [&](std::size_t i) { return table.first[i + 1] - table.first[i]; };
  const Ways ways(skeleton);
  // By internode: the thickest radius that meets at its tip. What starts within a thicker one's body meets that, too.
  std::vector<double> at_tip(all.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Internode& b : all) {
      Vec3 nearest;
      const double thick = std::max(b.base_radius, b.tip_radius);
      if (distance_to(b, all[i].tip, nearest) < thick) at_tip[i] = std::max(at_tip[i], thick);
    }
  }
  const auto at_base = [&](const Internode& a) {
    return a.parent == kNoInternode ? a.base_radius : at_tip[static_cast<std::size_t>(a.parent)];
  };
  // How far a place lies beyond the thickest radius that meets there, in units of it, from whichever axis it is least;
  // any number up to `least` if less than that.
  const auto beyond = [&](const Vec3& p, double least) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all.size() && lowest > least; ++i) {
      const Internode& a = all[i];
      Vec3 nearest;
      const double distance = distance_to(a, p, nearest);
      const double own = reach_across(a, glm::distance(a.base, nearest) / glm::distance(a.base, a.tip));
      lowest = std::min(lowest, distance / own - 1);
    }
    for (std::size_t i = 0; i < all.size() && lowest > least; ++i) {
      Vec3 nearest;
      const double distance = distance_to(all[i], p, nearest);
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (distance < (1 + lowest) * at_tip[k] && ways.between(i, nearest, k, all[k].tip) < 3 * at_tip[k]) {
          lowest = distance / at_tip[k] - 1;
        }
      }
    }
    return lowest;
  };
  const auto is_away = [&](const Vec3& p) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (children(i) != 1 && glm::distance(p, all[i].tip) < 3 * at_tip[i]) return false;
    }
    return glm::distance(p, all[0].base) >= 3 * all[0].base_radius;
  };
  // Within three radii of where an axis turns gently.
  const auto bends_at = [&](const Vec3& p) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (children(k) != 1 || glm::distance(p, all[k].tip) >= 3 * at_tip[k]) continue;
      const Internode& child = all[static_cast<std::size_t>(table.children[table.first[k]])];
      const double cosine = glm::dot(glm::normalize(all[k].tip - all[k].base), glm::normalize(child.tip - child.base));
      if (cosine > std::cos(30 * kDegree)) return true;
    }
    return false;
  };
  // Whether another internode by itself reaches a place.
  const auto is_others = [&](std::size_t i, const Vec3& end) {
    for (std::size_t b = 0; b < all.size(); ++b) {
      if (b == i) continue;
      const Sphere sphere = nearest_sphere(Cone{all[b].base, all[b].tip, all[b].base_radius, all[b].tip_radius}, end);
      if (glm::distance(sphere.center, end) < 1.001 * sphere.radius) return true;
    }
    return false;
  };
  // What reaches a ray's end and lies on its side makes a fillet; what the tree's way to is much longer than the
  // straight one passes by.
  const auto is_free = [&](std::size_t i, const Ray& ray, const Vec3& end) {
    for (std::size_t b = 0; b < all.size(); ++b) {
      Vec3 nearest;
      const double thick = std::max(all[b].base_radius, all[b].tip_radius);
      if (b == i || distance_to(all[b], end, nearest) >= 2 * thick) continue;
      const double to_side =
          std::max({glm::dot(nearest - ray.origin, ray.direction), glm::dot(all[b].base - ray.origin, ray.direction),
                    glm::dot(all[b].tip - ray.origin, ray.direction)});
      if (to_side > 0.2 * std::min(thick, ray.own)) return false;
      const double way = ways.between(i, ray.origin, b, nearest);
      if (way > 1.5 * glm::distance(ray.origin, nearest) + 0.5 * ray.own) return false;
    }
    return true;
  };
  Dependability result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Internode& a = all[i];
    const double length = glm::distance(a.base, a.tip);
    Vec3 side, other;
    complete_frame((a.tip - a.base) / length, side, other);
    std::vector<Ray> rays;
    for (int j = 0; j < kAround; ++j) {
      const double turn = 2 * std::numbers::pi * j / kAround;
      for (int k = 0; k <= kAlong; ++k) {
        const double y = static_cast<double>(k) / kAlong;
        const Vec3 origin = a.base + y * (a.tip - a.base);
        rays.push_back({origin, std::cos(turn) * side + std::sin(turn) * other, reach_across(a, y), y, turn,
                        is_away(origin), bends_at(origin)});
      }
    }
    const std::vector<double> radii = exits(field, rays, kMost * std::max(at_base(a), at_tip[i]));
    std::vector<bool> free(rays.size());
    for (std::size_t k = 0; k < rays.size(); ++k) {
      free[k] = is_free(i, rays[k], rays[k].origin + radii[k] * rays[k].direction);
    }
    double lowest = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const Ray& ray = rays[k];
      if (ray.along == 0) lowest = std::numeric_limits<double>::infinity();
      if (radii[k] <= 0) {
        ++result.missing;
        continue;
      }
      const std::size_t across = (k + rays.size() / 2) % rays.size();
      const double radius = radii[k] / ray.own, half_thickness = 0.5 * (radii[k] + radii[across]) / ray.own;
      const bool before_fork = children(i) > 0 && (1 - ray.along) * length < 0.1 * a.tip_radius;
      if (!before_fork) {
        const bool off_axis = ray.bends || !ray.away;
        result.necking.consider(1 - (off_axis ? half_thickness : radius), i, ray.along, ray.azimuth);
        result.rounding.consider(1 - radius, i, ray.along, ray.azimuth);
      }
      if (!free[k]) continue;
      const Vec3 end = ray.origin + radii[k] * ray.direction;
      result.swelling.consider(beyond(end, result.swelling.value), i, ray.along, ray.azimuth);
      if (!ray.away || (ray.bends && !free[across])) continue;
      const double measured = ray.bends ? half_thickness : radius;
      if (measured > std::max(1.0, lowest + result.ring.value) && is_others(i, end)) continue;
      lowest = std::min(lowest, measured);
      result.ring.consider(measured - lowest, i, ray.along, ray.azimuth);
    }
  }
  return result;
}

}  // namespace barkridge::test
