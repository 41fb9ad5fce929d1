// Figures 14 to 18: what is taken away, bent internodes, and the poplar.

#include <fmt/format.h>

#include <array>

#include "tests/gallery/figure_measures.h"
#include "tests/gallery/figure_scene.h"
#include "tests/gallery/theory.h"
#include "tests/support/surface_measures.h"

namespace barkridge::test {

FigureMeasures measure_cuts() {
  const FigureScene figure = load_figure("figures/14_pruned.toml");
  const Vec3 left(-2.8, 0, -2.1), right(2, 0, 1.5), up(0, 1, 0);
  const Vec3 lateral(std::sin(50 * kDegree), std::cos(50 * kDegree), 0);
  FigureMeasures measures;
  // How far the surface is off the plane through `middle` at most, on a square of half the width `reach` around it.
  const auto unevenness = [&](const Vec3& middle, const Vec3& normal, double reach) {
    const Vec3 across = glm::normalize(glm::cross(normal, Vec3(0, 0, 1))), along = glm::cross(normal, across);
    double largest = 0;
    for (int i = -10; i <= 10; ++i) {
      for (int j = -10; j <= 10; ++j) {
        const Vec3 p = middle + 0.1 * reach * (static_cast<double>(i) * across + static_cast<double>(j) * along);
        // From within the saw's kerf, half a unit above the cut.
        const auto found = first_inside(*figure.field, {p + 0.5 * normal, -normal}, 3);
        largest = std::max(largest, found ? std::abs(*found - 0.5) : 1);
      }
    }
    return largest;
  };
  measures.push_back(
      {"left: largest distance of the cut from a plane", unevenness(left + 2.0 * lateral, lateral, 0.35), 0, 1e-9, 9});
  measures.push_back({"right, leader: the same", unevenness(right + 1.2 * up, up, 0.5), 0, 1e-9, 9});
  measures.push_back({"right, lateral: the same", unevenness(right + 1.2 / lateral.y * lateral, up, 0.35), 0, 1e-9, 9});
  return measures;
}

FigureMeasures measure_scars() {
  const FigureScene figure = load_figure("figures/15_scars.toml");
  struct Scar {
    std::string name;
    double y;
    Line stub;
    double hollow_depth, hollow_radius;
  };
  const auto on_z = [](double y, double from, double to, double radius) {
    return Line{Vec3(0, y, from), Vec3(0, y, to), radius};
  };
  const std::array<Scar, 3> scars{Scar{"large", -2, on_z(-2, 0.4, 0.6, 0.5), 1.45, 0.4},
                                  Scar{"middle", 0.1, on_z(0.1, 0.5, 0.75, 0.35), 1.3, 0.28},
                                  Scar{"small", 1.7, on_z(1.7, 0.6, 0.85, 0.2), 1.15, 0.16}};
  FigureMeasures measures;
  for (const Scar& scar : scars) {
    // The section through the scar's middle along the trunk: how far the surface is in front of the trunk's axis.
    const auto measured = [&](double y) { return surface_radius(*figure.field, Vec3(0, y, 0), Vec3(0, 0, 1), 2); };
    const auto expected = [&](double y) {
      return outermost_root(
          [&](double z) {
            const Vec3 p(0, y, z);
            return g(z / 2) + scar.stub.value(p) -
                   g(glm::distance(p, Vec3(0, scar.y, scar.hollow_depth)) / (2 * scar.hollow_radius));
          },
          kHalf, 0.5, 2);
    };
    // The rim is the highest point above the middle.
    const auto rim = [&](const auto& section) {
      std::pair<double, double> highest{0, 0};
      for (double y = 0; y < 1; y += 0.002) {
        const double z = section(scar.y + y);
        if (z > highest.second) highest = {y, z};
      }
      return highest;
    };
    const auto [half_width, height] = rim(measured);
    const auto [half_width_expected, height_expected] = rim(expected);
    measures.push_back({scar.name + " scar: height of the rim above the bark", height - 1, height_expected - 1});
    measures.push_back(
        {scar.name + " scar: depth below the rim", height - measured(scar.y), height_expected - expected(scar.y)});
    measures.push_back({scar.name + " scar: width from rim to rim", 2 * half_width, 2 * half_width_expected, 1e-2});
  }
  return measures;
}

FigureMeasures measure_bend() {
  const FigureScene figure = load_figure("figures/16_bent.toml");
  const Internode& trunk = figure.skeleton.internodes[0];
  const Internode& lateral = figure.skeleton.internodes[2];
  const Vec3 chord = lateral.tip - lateral.base, axis = glm::normalize(chord);
  const Vec3 up = glm::normalize(trunk.tip - trunk.base), away = glm::normalize(glm::dot(up, axis) * axis - up);
  const double half = 30 * kDegree, arc_radius = glm::length(chord) / (2 * std::sin(half));
  // Both sides of the lateral as a line through the middle of its chord meets them: the arc is between.
  const Vec3 middle = lateral.base + 0.5 * chord;
  const double farther = surface_radius(*figure.field, middle, away, 3);
  const double nearer = first_inside(*figure.field, {middle, away}, 3).value_or(0);
  FigureMeasures measures;
  measures.push_back(
      {"distance of the arc from its chord", 0.5 * (farther + nearer), arc_radius * (1 - std::cos(half)), 1e-5});
  measures.push_back(
      {"radius of the lateral in the arc's middle", 0.5 * (farther - nearer), lateral.base_radius, 1e-5});
  // At its tip the arc has come back by half the angle, and the cap is where it would be without a bend.
  const Vec3 end = std::cos(half) * axis - std::sin(half) * away;
  measures.push_back({"reach past the tip, along the arc's end", surface_radius(*figure.field, lateral.tip, end, 2),
                      lateral.tip_radius, 1e-5});
  return measures;
}

namespace {

// The angle between the walls where a lateral leaves the trunk, as parallel rays into the crotch see them.
double crotch_opening_degrees(const Field& field, const Internode& trunk, const Internode& lateral) {
  const Vec3 up = glm::normalize(trunk.tip - trunk.base), out = glm::normalize(lateral.tip - lateral.base);
  const Vec3 bisector = glm::normalize(up + out), across = glm::normalize(out - up);
  const double width = lateral.base_radius;
  // Where the lateral's upper side would meet the trunk's.
  const Vec3 crotch = lateral.base + (trunk.tip_radius * out + width * up) / glm::length(glm::cross(up, out));
  const RayFan fan = [&](double t) {
    return Ray{crotch + 3 * width * bisector + 3 * width * (t - 0.5) * across, -bisector};
  };
  const auto near = field.restricted(grown({crotch, crotch}, 8 * width));
  return sharpest_opening_degrees(*near, fan, 5 * width, 0.02 * width);
}

FigureMeasures measure_crotches(const std::string& scene, std::optional<double> expected) {
  constexpr int kLaterals = 10;
  const Model model = make_model(load_scene(BARKRIDGE_SOURCE_DIR "/scenes/" + scene));
  const auto field = compile(model.tree);
  double least = 180, largest = 0;
  int laterals = 0;
  for (const Internode& lateral : model.skeleton.internodes) {
    if (lateral.order != 1 || laterals == kLaterals) continue;
    const Internode& trunk = model.skeleton.internodes[static_cast<std::size_t>(lateral.parent)];
    if (trunk.order != 0) continue;
    ++laterals;
    const double opening = crotch_opening_degrees(*field, trunk, lateral);
    least = std::min(least, opening);
    largest = std::max(largest, opening);
  }
  const std::string what = fmt::format("opening across the crotches of the {} lowest laterals in degrees", laterals);
  return {{what + ", least", least, expected, 0.01, 1}, {what + ", largest", largest, expected, 0.01, 1}};
}

}  // namespace

// A sum of C1 fields is smooth.
FigureMeasures measure_smooth_poplar() { return measure_crotches("poplar_smooth.toml", 180); }

// How far a ridge seems open depends on where one wall hides the other.
FigureMeasures measure_ridged_poplar() { return measure_crotches("poplar.toml", std::nullopt); }

}  // namespace barkridge::test
