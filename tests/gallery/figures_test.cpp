// Every figure shows what the paper says, in numbers. The measures are taken from the scenes themselves, so that
// picture, number and theory stay together.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "blobtree/from_skeleton.h"
#include "tests/gallery/figure_measures.h"
#include "tests/gallery/figure_scene.h"
#include "tests/support/random_source.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// Holds every measure for which there is a theory against it, and returns how many those are.
std::size_t check_against_theory(const FigureMeasures& measures) {
  std::size_t count = 0;
  for (const FigureMeasure& measure : measures) {
    if (!measure.expected) continue;
    ++count;
    CAPTURE(measure.what);
    CHECK(measure.measured == Approx(*measure.expected).margin(measure.tolerance).epsilon(0));
  }
  return count;
}

double measured(const FigureMeasures& measures, const std::string& what) {
  for (const FigureMeasure& measure : measures) {
    if (measure.what == what) return measure.measured;
  }
  FAIL("no measure is called \"" << what << '"');
  return 0;
}

}  // namespace

TEST_CASE("figure 7: the cone's surface touches all spheres along its axis") {
  CHECK(check_against_theory(measure_cone()) == 3);
}

TEST_CASE("figure 8: two lines that end in one point bulge by a third, as far as sqrt 3 radii") {
  const FigureMeasures measures = measure_bulge();
  CHECK(check_against_theory(measures) == 3);
  CHECK(measured(measures, "radius at the joint over that of the lines") == Approx(1.33).margin(5e-4));
}

TEST_CASE("figure 9: equation 4 takes the bulge away and leaves the elbow round") {
  const FigureMeasures measures = measure_shortened();
  CHECK(check_against_theory(measures) == 5);
  CHECK(measured(measures, "left: radius out of the plane over that of the lines, largest") > 1.32);
  CHECK(measured(measures, "right: the same, largest") < 1.002);
  CHECK(measured(measures, "right: the same, least") > 0.997);
}

TEST_CASE("figure 10: cones joined at 180 and at 90 degrees have the same slight bulge") {
  const FigureMeasures measures = measure_turned();
  CHECK(check_against_theory(measures) == 4);
  CHECK(measured(measures, "180 degrees: radius out of the plane over that of the taper, largest") < 1.03);
  CHECK(measured(measures, "90 degrees: radius out of the plane over that of the taper, largest") ==
        Approx(measured(measures, "180 degrees: radius out of the plane over that of the taper, largest")));
}

TEST_CASE("figure 11: branches that share their parent's cross-section blend without noticeable bulge") {
  const FigureMeasures measures = measure_branching();
  CHECK(check_against_theory(measures) == 6);
  for (const FigureMeasure& measure : measures) CHECK(measure.measured < 1.02);
}

TEST_CASE("figure 12: branches that start at the branching point bulge below it, displaced ones do not") {
  const FigureMeasures measures = measure_displaced();
  CHECK(check_against_theory(measures) == 4);
  CHECK(measured(measures, "left: largest radius below the branching point, out of the plane") > 1.04);
  CHECK(measured(measures, "right: largest radius below the branching point, out of the plane") < 1.0005);
}

TEST_CASE("figure 12: its right panel is what the paper's joints make of a skeleton") {
  const double radius = std::sqrt(0.5);
  Skeleton skeleton = junction({{20, 0, radius}, {20, 180, radius}}, 6);
  TreeOptions options;
  options.joint = JointKind::kPaper;
  const auto fork = reference_field(tree_from_skeleton(skeleton, options));
  const auto figure = load_figure("figures/12_displaced.toml").field;
  RandomSource random(12);
  for (int i = 0; i < 2000; ++i) {
    // Out of the left panel's reach.
    const Vec3 p = random.in_box({Vec3(-1.2, -7, -1.2), Vec3(3, 7, 2)});
    const Vec3 there = p + Vec3(2.4, 0, 1.8);
    double expected = 0, value = 0;
    fork->values({&p, 1}, {&expected, 1});
    figure->values({&there, 1}, {&value, 1});
    REQUIRE(value == Approx(expected).margin(1e-8));
  }
}

TEST_CASE("figure 12: the ridge closes from a blend to walls that touch, and swells by g^-1(T - M)") {
  const FigureMeasures measures = measure_ridge();
  CHECK(check_against_theory(measures) == 9);
  double before = 180;
  for (const char* const height : {"-0.2", "0.2", "0.6", "0.8", "1"}) {
    const double opening = measured(measures, std::string("opening of the crease at height ") + height + " in degrees");
    CHECK(opening < before);
    before = opening;
  }
  CHECK(before < 0.1);
}

TEST_CASE(
    "figure 13: thin laterals have a collar all around, thick ones flow into the trunk and keep their ridge above") {
  const FigureMeasures measures = measure_collars();
  CHECK(check_against_theory(measures) == 16);
  double before = -1;
  for (const char* const ratio : {"0.15", "0.30", "0.50", "0.70"}) {
    const std::string lateral = std::string("lateral of ") + ratio;
    CHECK(measured(measures, lateral + ": opening of the crease above it in degrees") < 0.1);
    const double below = measured(measures, lateral + ": opening of the crease below it in degrees");
    CHECK(below >= before - 1e-3);
    before = below;
  }
  CHECK(measured(measures, "lateral of 0.15: opening of the crease below it in degrees") < 0.1);
  CHECK(before > 179.9);
}

TEST_CASE("figure 14: a cut is flat, across a lateral and across a whole fork") {
  CHECK(check_against_theory(measure_cuts()) == 3);
}

TEST_CASE("figure 15: scars have a rim, a depth and a width that follow from stub and hollow") {
  const FigureMeasures measures = measure_scars();
  CHECK(check_against_theory(measures) == 9);
  CHECK(measured(measures, "large scar: width from rim to rim") >
        measured(measures, "middle scar: width from rim to rim"));
  CHECK(measured(measures, "middle scar: width from rim to rim") >
        measured(measures, "small scar: width from rim to rim"));
}

TEST_CASE("figure 16: a bent internode is an arc between its old ends, as thick as before") {
  CHECK(check_against_theory(measure_bend()) == 3);
}

TEST_CASE("figures 17 and 18: the poplar's crotches are smooth, and sharp with precise contact") {
  CHECK(check_against_theory(measure_smooth_poplar()) == 2);
  const FigureMeasures ridges = measure_ridged_poplar();
  CHECK(measured(ridges, "opening across the crotches of the 10 lowest laterals in degrees, largest") < 45);
}

TEST_CASE(
    "the gallery's document has every scene of the figures, every picture that it shows, and the numbers as they are") {
  namespace fs = std::filesystem;
  const fs::path docs = fs::path(BARKRIDGE_SOURCE_DIR) / "docs";
  std::ifstream file(docs / "gallery.md");
  const std::string gallery{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto says = [&](const std::string& text) { return gallery.find(text) != std::string::npos; };
  for (const auto& entry : fs::directory_iterator(fs::path(BARKRIDGE_SOURCE_DIR) / "scenes/figures")) {
    CAPTURE(entry.path().string());
    CHECK(says("scenes/figures/" + entry.path().filename().string()));
  }
  std::size_t shown = 0;
  for (const auto& entry : fs::directory_iterator(docs / "images/gallery")) {
    CAPTURE(entry.path().string());
    CHECK(says("](images/gallery/" + entry.path().filename().string() + ")"));
    ++shown;
  }
  std::size_t links = 0;
  for (std::size_t at = 0; (at = gallery.find("](images/gallery/", at)) != std::string::npos; ++at) ++links;
  CHECK(links == shown);
  for (const auto& [figure, measure] : figure_meters()) {
    for (const FigureMeasure& it : measure()) {
      CAPTURE(figure, it.what);
      // What theory is silent about depends on the instruction set in its last digits.
      CHECK(says(it.expected ? table_row(it) : "| " + it.what + " |"));
    }
  }
}
