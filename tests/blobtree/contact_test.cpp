#include "blobtree/contact.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/support/random_source.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// A field of constant value around the origin: a sphere so large that it is flat there.
NodeId add_value_sphere(BlobTree& tree, double distance_ratio, const Vec3& direction) {
  const double radius = 1;
  return tree.add(
      Cone{2 * radius * distance_ratio * direction, 2 * radius * distance_ratio * direction, radius, radius});
}

double value_at_origin(const BlobTree& tree) {
  const Vec3 p(0);
  double value = 0;
  reference_field(tree)->values({&p, 1}, {&value, 1});
  return value;
}

// What a child with field `f` does to another.
double contact_effect(const ContactShape& shape, double f) {
  return f >= kIsoValue ? kIsoValue - f : contact_expansion(shape, kIsoValue - f);
}

}  // namespace

TEST_CASE("the expansion has the ends, peak and slopes that the theory states") {
  for (const auto& [w, m] : {std::pair{0.5, 0.125}, {0.5, 0.5 / 6}, {0.3, 0.1}, {0.5, 0.5 / 3}}) {
    const ContactShape shape{w, m, false};
    CHECK(contact_expansion(shape, 0) == 0);
    CHECK(contact_expansion(shape, w / 2) == Approx(m));
    CHECK(contact_expansion(shape, w) == 0);
    CHECK(contact_expansion_slope(shape, 0) == Approx(1));
    CHECK(contact_expansion_slope(shape, w / 2) == Approx(0).margin(1e-12));
    CHECK(contact_expansion_slope(shape, w * (1 - 1e-9)) == Approx(0).margin(1e-6));
    double previous = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double x = w * i / 1000, h = contact_expansion(shape, x);
      CHECK(h <= m * (1 + 1e-12));
      CHECK(h >= 0);
      CHECK(std::abs(h - previous) <= w / 1000 * (1 + 1e-9));  // |h'| <= 1
      // A child that is almost zero adds at most what it is.
      CHECK(contact_expansion(shape, kIsoValue - x) <= x + 1e-12);
      previous = h;
    }
  }
}

TEST_CASE("the range of an expansion encloses its values and slopes") {
  RandomSource random(1);
  for (int i = 0; i < 2000; ++i) {
    const double w = random.uniform(0.05, 0.5);
    const ContactShape shape{w, random.uniform(w / 6, 0.4), true};
    const double a = random.uniform(-0.5, 1.5), b = random.uniform(-0.5, 1.5);
    const Interval f{std::min(a, b), std::max(a, b)};
    const ContactRange range = contact_range(shape, f);
    for (int k = 0; k <= 50; ++k) {
      const double x = f.lo + (f.hi - f.lo) * k / 50;
      CHECK(contact_effect(shape, x) <= range.highest_expansion + 1e-12);
      CHECK(std::abs(contact_effect_slope(shape, x)) <= range.steepest_effect + 1e-9);
    }
  }
}

TEST_CASE("contact does not depend on the order of the children") {
  RandomSource random(2);
  for (int i = 0; i < 500; ++i) {
    std::vector<std::pair<double, Vec3>> spheres;
    for (int k = 0; k < 4; ++k) spheres.push_back({random.uniform(0.1, 1.1), random.direction()});
    double first = 0;
    for (int turn = 0; turn < 4; ++turn) {
      std::rotate(spheres.begin(), spheres.begin() + 1, spheres.end());
      if (turn == 2) std::swap(spheres[0], spheres[3]);
      BlobTree tree;
      std::vector<NodeId> children;
      for (const auto& [ratio, direction] : spheres) children.push_back(add_value_sphere(tree, ratio, direction));
      tree.add(Contact{}, children);
      const double value = value_at_origin(tree);
      if (turn == 0) first = value;
      CHECK(value == Approx(first).epsilon(1e-14));
    }
  }
}

TEST_CASE("two children in contact never hollow each other out") {
  RandomSource random(3);
  for (int i = 0; i < 2000; ++i) {
    BlobTree tree;
    const NodeId a = add_value_sphere(tree, random.uniform(0, 0.5), random.direction());
    const NodeId b = add_value_sphere(tree, random.uniform(0, 0.5), random.direction());
    tree.add(Contact{}, {a, b});
    CHECK(value_at_origin(tree) >= kIsoValue);
  }
}

TEST_CASE("a child that is zero somewhere changes nothing there") {
  BlobTree alone;
  add_value_sphere(alone, 0.4, Vec3(1, 0, 0));
  BlobTree tree;
  const NodeId a = add_value_sphere(tree, 0.4, Vec3(1, 0, 0));
  const NodeId b = add_value_sphere(tree, 1.2, Vec3(0, 1, 0));
  tree.add(Contact{}, {a, b});
  CHECK(value_at_origin(tree) == value_at_origin(alone));
}

TEST_CASE("contact shapes outside their ranges are refused by name") {
  const auto message = [](const ContactShape& shape) {
    try {
      check(shape);
    } catch (const InputError& error) {
      return error.message();
    }
    return std::string();
  };
  CHECK(message({0.5, 0.125, false}).empty());
  CHECK(message({0.5, 0.5 / 3, false}).empty());
  CHECK(message({0.5, 0.2, true}).empty());
  CHECK(message({0, 0.1, false}).find("width") != std::string::npos);
  CHECK(message({0.6, 0.15, false}).find("width") != std::string::npos);
  CHECK(message({0.5, 0.05, false}).find("swelling") != std::string::npos);
  CHECK(message({0.5, 0.2, false}).find("allow_large_swelling") != std::string::npos);
  CHECK(message({std::nan(""), 0.1, false}).find("width") != std::string::npos);
  CHECK(message({0.5, std::nan(""), false}).find("swelling") != std::string::npos);
}
