#include "polygonize/edge_roots.h"

#include <catch2/catch.hpp>

#include "tests/support/analytic_fields.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

constexpr double kTolerance = 1e-6;

// The root along x from 0 to 1 of F - iso = f(x), and the number of evaluations it took.
std::pair<double, std::size_t> root_of(const std::function<double(double)>& f) {
  const AnalyticField field(cube(Vec3(0), 2), 1, [&](const Vec3& p) {
    return ValueAndGradient{kIsoValue + f(p.x), Vec3(0)};
  });
  EdgeCrossing crossing;
  crossing.ends = {{{0, f(0)}, {1, f(1)}}};
  crossing.most = 1;
  RootScratch scratch;
  find_roots(field, kTolerance, std::span(&crossing, 1), scratch);
  CHECK(crossing.point.y == 0);
  return {crossing.point.x, field.counts().evaluations};
}

}  // namespace

TEST_CASE("roots of smooth fields take few evaluations") {
  for (const double r : {0.001, 0.1, 0.37, 0.5, 0.85, 0.999}) {
    CAPTURE(r);
    const auto linear = root_of([=](double x) { return 0.3 * (r - x); });
    CHECK(linear.first == Approx(r).margin(kTolerance));
    CHECK(linear.second <= 2);
    const auto rising = root_of([=](double x) { return 0.3 * (x - r); });
    CHECK(rising.first == Approx(r).margin(kTolerance));
    const auto curved = root_of([=](double x) { return 1 / ((x + 0.7) * (x + 0.7)) - 1 / ((r + 0.7) * (r + 0.7)); });
    CHECK(curved.first == Approx(r).margin(kTolerance));
    CHECK(curved.second <= 6);
  }
}

TEST_CASE("roots are found where interpolation is no help") {
  for (const double r : {0.001, 0.1, 0.37, 0.5, 0.85, 0.999}) {
    CAPTURE(r);
    const auto flat = root_of([=](double x) { return (r - x) * (r - x) * (r - x); });
    CHECK(flat.first == Approx(r).margin(1e-4));  // where the field is less than 1e-12 away
    CHECK(flat.second <= 60);
    const auto jump = root_of([=](double x) { return x < r ? 0.5 : -1e-9; });
    CHECK(jump.first == Approx(r).margin(kTolerance));
    CHECK(jump.second <= 60);
    const auto steep = root_of([=](double x) { return std::tanh(1e4 * (r - x)); });
    CHECK(steep.first == Approx(r).margin(kTolerance));
    const auto kinked = root_of([=](double x) { return x < r ? 1e-3 * (r - x) : 50 * (r - x); });
    CHECK(kinked.first == Approx(r).margin(kTolerance));
    const auto undefined = root_of([=](double x) { return x <= r ? 0.25 : std::nan(""); });
    CHECK(undefined.first == Approx(r).margin(kTolerance));
  }
}

TEST_CASE("a stretch of exactly the iso-value belongs to the solid") {
  for (const double r : {0.0, 1e-7, 0.1, 0.37, 0.999}) {
    CAPTURE(r);
    const auto after_sheet = root_of([=](double x) { return x <= r ? 0.0 : r - x - 1e-3; });
    CHECK(after_sheet.first == Approx(r).margin(kTolerance));
    const auto before_sheet = root_of([=](double x) { return 1 - x <= r ? 0.0 : r - (1 - x); });
    CHECK(before_sheet.first == Approx(1 - r).margin(kTolerance));
    CHECK(before_sheet.second <= 60);
  }
}

TEST_CASE("roots stay within their limits and do not depend on each other") {
  const AnalyticField field = ball_field(Vec3(0), 1);
  std::vector<EdgeCrossing> all;
  for (int i = 0; i < 50; ++i) {
    EdgeCrossing c;
    c.axis = i % 3;
    c.point = Vec3(0.01 * i, 0.3, -0.2);
    const auto at = [&](double x) {
      Vec3 p = c.point;
      p[c.axis] = x;
      double value = 0;
      field.values(std::span(&p, 1), std::span(&value, 1));
      return value - kIsoValue;
    };
    c.least = 0.5;
    c.most = i % 2 == 0 ? 1.1 : 0.7;
    c.ends = {{{0.5, at(0.5)}, {1.1, at(1.1)}}};
    all.push_back(c);
  }
  std::vector<EdgeCrossing> each = all;
  RootScratch scratch;
  find_roots(field, kTolerance, all, scratch);
  for (std::size_t i = 0; i < each.size(); ++i) {
    find_roots(field, kTolerance, std::span(&each[i], 1), scratch);
    CHECK(each[i].point == all[i].point);
    if (i % 2 == 0) CHECK(glm::length(all[i].point) == Approx(1).margin(2 * kTolerance));
    if (i % 2 == 1) CHECK(all[i].point[all[i].axis] <= 0.7);
  }
}
