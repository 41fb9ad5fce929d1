// Figures 7 to 11: primitives and sums of them.

#include <fmt/format.h>

#include "tests/gallery/figure_measures.h"
#include "tests/gallery/figure_scene.h"
#include "tests/gallery/theory.h"
#include "tests/support/surface_measures.h"

namespace barkridge::test {

namespace {

using Formula = std::function<double(const Vec3&)>;

// Radius of the surface of a field given by a formula.
double formula_radius(const Formula& field, const Vec3& axis_point, const Vec3& direction) {
  return outermost_root([&](double rho) { return field(axis_point + rho * direction); }, kHalf, 0.5, 1.6);
}

// The least and the largest radius of a surface around an axis, in multiples of what it should be.
struct Range {
  double lowest = 10, highest = 0;
  void add(double ratio) {
    lowest = std::min(lowest, ratio);
    highest = std::max(highest, ratio);
  }
};

// Radii along the unit vector `axis` from the origin, at 61 places from `from` to `to`, each divided by what is due
// there.
template <typename Radius, typename Due>
void add_radii(Range& range, const Radius& radius, const Vec3& axis, double from, double to, const Due& due) {
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    const double y = from + (to - from) * i / kSteps;
    range.add(radius(y * axis) / due(y));
  }
}

void append_range(FigureMeasures& measures, const std::string& what, const Range& measured, const Range& expected) {
  measures.push_back({what + ", largest", measured.highest, expected.highest});
  measures.push_back({what + ", least", measured.lowest, expected.lowest});
}

}  // namespace

FigureMeasures measure_cone() {
  const FigureScene figure = load_figure("figures/07_cone.toml");
  // A cone of slope s touches all its spheres, so across its axis it is 1 / sqrt(1 - s^2) times as wide as the sphere
  // there.
  const double slope = (0.75 - 1.5) / 8, across = 1 / std::sqrt(1 - slope * slope);
  FigureMeasures measures;
  for (const double along : {2.0, 6.0}) {
    measures.push_back({fmt::format("radius across the axis, {} from the base", along),
                        surface_radius(*figure.field, Vec3(along, 0, 0), Vec3(0, 0, 1), 3),
                        (1.5 + slope * along) * across});
  }
  measures.push_back({"reach past the thin end", surface_radius(*figure.field, Vec3(8, 0, 0), Vec3(1, 0, 0), 3), 0.75});
  return measures;
}

FigureMeasures measure_bulge() {
  const FigureScene figure = load_figure("figures/08_bulge.toml");
  const auto radius = [&](double along) {
    return surface_radius(*figure.field, Vec3(along, 0, 0), Vec3(0, 0, 1), 1.9);
  };
  FigureMeasures measures;
  // Where the lines meet either counts in full: 2 g(u) = 1/2.
  measures.push_back({"radius at the joint over that of the lines", radius(0), radii_at(kHalf / 2)});
  // Beside it one line is as far as its axis, the other as far as its end; past sqrt 3 that is out of reach.
  const auto expected = [](double along) {
    return outermost_root([&](double rho) { return g(rho / 2) + g(std::hypot(along, rho) / 2); }, kHalf, 0.5, 1.6);
  };
  measures.push_back({"the same, one radius beside it", radius(1), expected(1)});
  measures.push_back({"the same, sqrt 3 radii beside it", radius(std::sqrt(3.0)), 1.0});
  return measures;
}

FigureMeasures measure_shortened() {
  const FigureScene figure = load_figure("figures/09_shortened.toml");
  const Vec3 out(0, 0, 1), up(0, 1, 0), turned(std::sqrt(0.75), 0.5, 0);
  const auto one = [](double) { return 1.0; };
  const auto ranges = [&](double panel, double shortening) {
    const Line a{-6.0 * up, -shortening * up, 1}, b{Vec3(0), 6.0 * turned, 1};
    const Formula sum = [&](const Vec3& p) { return a.value(p) + b.value(p); };
    Range measured, expected;
    for (const Vec3& axis : {-up, turned}) {
      add_radii(
          measured, [&](const Vec3& p) { return surface_radius(*figure.field, Vec3(panel, 0, 0) + p, out, 1.9); }, axis,
          0, 4, one);
      add_radii(
          expected, [&](const Vec3& p) { return formula_radius(sum, p, out); }, axis, 0, 4, one);
    }
    return std::pair{measured, expected};
  };
  FigureMeasures measures;
  const auto [left, left_expected] = ranges(-4.5, 0);
  const auto [right, right_expected] = ranges(4.5, 1.75);
  append_range(measures, "left: radius out of the plane over that of the lines", left, left_expected);
  append_range(measures, "right: the same", right, right_expected);
  // Along the bisector of the elbow only the end of B is near.
  measures.push_back({"right: radius at the outer elbow",
                      surface_radius(*figure.field, Vec3(4.5, 0, 0), glm::normalize(up - turned), 1.9), 1.0});
  return measures;
}

FigureMeasures measure_turned() {
  const FigureScene figure = load_figure("figures/10_turned.toml");
  const Vec3 out(0, 0, 1), up(0, 1, 0);
  const double slope = 1 / 30.0, across = 1 / std::sqrt(1 - slope * slope);
  FigureMeasures measures;
  for (const auto& [name, panel, axis] :
       {std::tuple{"180 degrees", -5.0, up}, std::tuple{"90 degrees", 2.0, Vec3(1, 0, 0)}}) {
    const Vec3 origin(panel, 0, 0), b_axis = axis;
    const Formula sum = [&](const Vec3& p) {
      return largest_sphere(-6.0 * up, -1.75 * up, 1.2, 1 + 1.75 * slope, p) +
             largest_sphere(Vec3(0), 6.0 * b_axis, 1, 0.8, p);
    };
    Range measured, expected;
    for (const auto& [direction, taper] : {std::pair{-up, slope}, std::pair{b_axis, -slope}}) {
      const double change = taper;
      const auto due = [&](double y) { return (1 + change * y) * across; };
      add_radii(
          measured, [&](const Vec3& p) { return surface_radius(*figure.field, origin + p, out, 1.9); }, direction, 0, 4,
          due);
      add_radii(
          expected, [&](const Vec3& p) { return formula_radius(sum, p, out); }, direction, 0, 4, due);
    }
    append_range(measures, fmt::format("{}: radius out of the plane over that of the taper", name), measured, expected);
  }
  return measures;
}

FigureMeasures measure_branching() {
  const FigureScene figure = load_figure("figures/11_branching.toml");
  const auto& internodes = figure.skeleton.internodes;
  const auto one = [](double) { return 1.0; };
  FigureMeasures measures;
  // A trunk and the branches that it carries, as lines with the paper's joints.
  const auto add = [&](const std::string& name, std::size_t trunk, std::size_t branches) {
    const Vec3 p = internodes[trunk].tip, up(0, 1, 0);
    std::vector<Line> lines;
    double thickest = 0;
    Vec3 between(0);
    for (std::size_t i = trunk + 1; i <= trunk + branches; ++i) {
      lines.push_back({Vec3(0), internodes[i].tip - p, internodes[i].base_radius});
      thickest = std::max(thickest, internodes[i].base_radius);
    }
    lines.push_back({internodes[trunk].base - p, -1.75 * thickest * up, 1});
    const Vec3 first = lines.front().tip;
    between = branches == 2 ? glm::normalize(glm::cross(first, up)) : -glm::normalize(Vec3(first.x, 0, first.z));
    const Formula sum = [&](const Vec3& q) {
      double value = 0;
      for (const Line& line : lines) value += line.value(q);
      return value;
    };
    Range measured, expected;
    add_radii(
        measured, [&](const Vec3& q) { return surface_radius(*figure.field, p + q, between, 1.9); }, -up, 0.1, 4, one);
    add_radii(
        expected, [&](const Vec3& q) { return formula_radius(sum, q, between); }, -up, 0.1, 4, one);
    append_range(measures, name + ": radius of the trunk between the branches", measured, expected);
  };
  add("equal fork", 0, 2);
  add("leader and lateral", 3, 2);
  add("three branches", 6, 3);
  return measures;
}

}  // namespace barkridge::test
