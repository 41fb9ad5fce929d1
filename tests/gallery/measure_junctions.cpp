// Figures 12 and 13: branches in precise contact.

#include <fmt/format.h>

#include "tests/gallery/figure_measures.h"
#include "tests/gallery/figure_scene.h"
#include "tests/gallery/theory.h"
#include "tests/support/surface_measures.h"

namespace barkridge::test {

namespace {

const Vec3 kUp(0, 1, 0);

// ---- Figure 12: forks of two equal branches at 20 degrees.

struct Fork {
  Vec3 origin;  // of the panel; the lines are about it
  double radius = std::sqrt(0.5);
  Line trunk{-6.0 * kUp, -(2.75 * radius - 1) * kUp, 1};
  Line one, other;  // mirror images in the plane of y and z

  Fork(const Vec3& panel, double displacement) : origin(panel) {
    const Vec3 direction(std::sin(20 * kDegree), std::cos(20 * kDegree), 0), mirror(-1, 1, 1);
    one = {displacement * direction, 6.0 * direction, radius};
    other = {mirror * one.base, mirror * one.tip, radius};
  }
  double value(const Vec3& p) const { return trunk.value(p) + contact(one.value(p), other.value(p)); }
};

const Vec3 kLeft(-2.4, 0, -1.8), kRight(2.4, 0, 1.8);
const double kDisplacement = 1 - std::sqrt(0.5);  // equation 7

}  // namespace

FigureMeasures measure_displaced() {
  const FigureScene figure = load_figure("figures/12_displaced.toml");
  FigureMeasures measures;
  for (const auto& [name, panel, displacement] :
       {std::tuple{"left", kLeft, 0.0}, std::tuple{"right", kRight, kDisplacement}}) {
    const Fork fork(panel, displacement);
    for (const auto& [where, direction] : {std::pair{"in", Vec3(1, 0, 0)}, std::pair{"out of", Vec3(0, 0, 1)}}) {
      double measured = 0, expected = 0;
      for (double y = -3; y <= -0.05; y += 0.05) {
        const Vec3 p(0, y, 0), d = direction;
        measured = std::max(measured, surface_radius(*figure.field, fork.origin + p, d, 1.9));
        expected =
            std::max(expected, outermost_root([&](double rho) { return fork.value(p + rho * d); }, kHalf, 0.5, 1.6));
      }
      measures.push_back(
          {fmt::format("{}: largest radius below the branching point, {} the plane", name, where), measured, expected});
    }
  }
  return measures;
}

FigureMeasures measure_ridge() {
  const FigureScene figure = load_figure("figures/12_displaced.toml");
  const Fork fork(kRight, kDisplacement);
  FigureMeasures measures;
  // The crease lies in the plane of symmetry, where the branches' fields are equal.
  for (const double y : {-0.2, 0.2, 0.6, 0.8, 1.0, 1.4}) {
    const double z = outermost_root([&](double rho) { return fork.value(Vec3(0, y, rho)); }, kHalf, 0.05, 1.6);
    const Vec3 crease(0, y, z);
    const Vec3 trunk = fork.trunk.value(crease) > 0 ? fork.trunk.gradient(crease) : Vec3(0);
    const double expected =
        opening_degrees(trunk, fork.one.gradient(crease), fork.other.gradient(crease), fork.one.value(crease));
    measures.push_back({fmt::format("opening of the crease at height {} in degrees", y),
                        opening_degrees_at(*figure.field, fork.origin + crease, Vec3(1, 0, 0), Vec3(0, 0, 1)), expected,
                        0.2, 1});
  }
  // The un-swollen union: both branches and the trunk up to the branching point.
  Skeleton skeleton;
  skeleton.internodes.push_back({fork.origin - 6.0 * kUp, fork.origin, 1, 1});
  for (const Line* line : {&fork.one, &fork.other}) {
    skeleton.internodes.push_back({fork.origin, fork.origin + line->tip, line->radius, line->radius, 0, 1});
  }
  // Out of the trunk's reach the ridge is highest where the other branch's field is w / 2 below the iso-value: f = T -
  // M there.
  for (const double y : {1.2, 1.5, 1.8}) {
    double highest = 0;
    for (double x = 0; x < 1.2; x += 0.002) {
      const auto point = surface_point(*figure.field, {fork.origin + Vec3(x, y, 3), Vec3(0, 0, -1)}, 3);
      if (point) highest = std::max(highest, rise_above_union(skeleton, point->position));
    }
    measures.push_back({fmt::format("swelling above the un-swollen union at height {}, in radii of the branch", y),
                        highest / fork.radius, radii_at(kHalf - kSwelling) - 1, 1e-4});
  }
  return measures;
}

namespace {

// ---- Figure 13: a lateral beside a straight leader.

struct Lateral {
  Vec3 origin, direction, above;  // of the lateral; `above`, square to it, points to the crotch
  Line trunk, leader, lateral;    // with the paper's joints, about the origin

  Lateral(const Skeleton& skeleton, std::size_t first) {
    const Internode &a = skeleton.internodes[first], &b = skeleton.internodes[first + 1],
                    &c = skeleton.internodes[first + 2];
    origin = a.tip;
    direction = glm::normalize(c.tip - c.base);
    above = glm::normalize(kUp - glm::dot(kUp, direction) * direction);
    trunk = {a.base - origin, -(2.75 * b.base_radius - a.tip_radius) * kUp, a.tip_radius};
    leader = {(a.tip_radius - b.base_radius) * kUp, b.tip - origin, b.base_radius};
    lateral = {(a.tip_radius - c.base_radius) * direction, c.tip - origin, c.base_radius};
  }
  Vec3 around(double azimuth_degrees) const {
    return std::cos(azimuth_degrees * kDegree) * above +
           std::sin(azimuth_degrees * kDegree) * glm::cross(direction, above);
  }

  // The point of the crease in the half-plane at an azimuth about the lateral: where leader and lateral are equal and
  // the surface is. None where the lateral has flowed into the trunk.
  std::optional<Vec3> crease(double azimuth_degrees) const {
    const Vec3 side = around(azimuth_degrees);
    const auto on_contact = [&](double rho) {
      // Away from the trunk along the lateral the leader's field falls and its own stays.
      double lo = 0, hi = 4;
      for (int i = 0; i < 60; ++i) {
        const double s = 0.5 * (lo + hi);
        const Vec3 p = s * direction + rho * side;
        (leader.value(p) >= lateral.value(p) ? lo : hi) = s;
      }
      return lo * direction + rho * side;
    };
    const auto value = [&](double rho) {
      const Vec3 p = on_contact(rho);
      const double f = lateral.value(p);
      return trunk.value(p) + (f >= kHalf ? kHalf : f + h(kHalf - f));
    };
    const double reach = 2 * lateral.radius * (1 - 1e-6);
    if (value(reach) >= kHalf) return std::nullopt;
    return on_contact(outermost_root(value, kHalf, 0.1 * lateral.radius, reach));
  }
  double opening(const Vec3& p) const {
    const Vec3 carrier = trunk.value(p) > 0 ? trunk.gradient(p) : Vec3(0);
    return opening_degrees(carrier, leader.gradient(p), lateral.gradient(p), lateral.value(p));
  }
};

// The collar in the crotch, where the trunk does not reach: on either wall one field is T - h(b) and the other T - b,
// and the highest point over the un-swollen union is that which is farthest from the nearer of the two branches.
double collar_height(double leader_radius, double lateral_radius) {
  double highest = 0;
  for (int i = 1; i < 1000; ++i) {
    const double b = kWidth * i / 1000, near = radii_at(kHalf - h(b)) - 1, far = radii_at(kHalf - b) - 1;
    highest = std::max({highest, std::min(leader_radius * near, lateral_radius * far),
                        std::min(lateral_radius * near, leader_radius * far)});
  }
  return highest;
}

}  // namespace

FigureMeasures measure_collars() {
  const FigureScene figure = load_figure("figures/13_collars.toml");
  FigureMeasures measures;
  for (std::size_t first = 0; first < figure.skeleton.internodes.size(); first += 3) {
    const Lateral it(figure.skeleton, first);
    const double ratio = it.lateral.radius;
    Skeleton junction;
    for (std::size_t i = first; i < first + 3; ++i) junction.internodes.push_back(figure.skeleton.internodes[i]);
    // Rays into the crotch along the bisector.
    const Vec3 bisector = glm::normalize(it.direction + kUp), across = glm::cross(it.around(90), bisector);
    const Vec3 middle = it.origin + it.direction / glm::length(glm::cross(it.direction, kUp));
    double highest = 0;
    for (double x = -1.2; x < 1.2; x += 0.001) {
      const auto point = surface_point(*figure.field, {middle + 3.0 * bisector + x * across, -bisector}, 3.5);
      if (point) highest = std::max(highest, rise_above_union(junction, point->position));
    }
    measures.push_back({fmt::format("lateral of {:.2f}: height of the collar in the crotch", ratio), highest,
                        collar_height(it.leader.radius, ratio), 1e-3});
    for (const auto& [where, azimuth] :
         {std::pair{"above", 0.0}, std::pair{"beside", 90.0}, std::pair{"below", 180.0}}) {
      const Vec3 side = it.around(azimuth);
      const auto crease = it.crease(azimuth);
      // Without a crease, what rays from all around find between lateral and trunk.
      const RayFan fan = [&](double t) {
        const double angle = (10 + 100 * t) * kDegree;
        const Vec3 outward = std::cos(angle) * it.direction + std::sin(angle) * side;
        return Ray{middle + 2.5 * outward, -outward};
      };
      measures.push_back({fmt::format("lateral of {:.2f}: opening of the crease {} it in degrees", ratio, where),
                          crease ? opening_degrees_at(*figure.field, it.origin + *crease, it.direction, side)
                                 : sharpest_opening_degrees(*figure.field, fan, 3, 0.01),
                          crease ? it.opening(*crease) : 180, 0.2, 1});
    }
  }
  return measures;
}

}  // namespace barkridge::test
