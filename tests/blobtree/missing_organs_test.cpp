#include "blobtree/missing_organs.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "lsystem/prune.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

double value(const Field& field, const Vec3& p) {
  double f = 0;
  field.values({&p, 1}, {&f, 1});
  return f;
}
bool is_inside(const Field& field, const Vec3& p) { return value(field, p) >= kIsoValue; }

// A trunk that goes on, and a lateral.
Skeleton with_lateral(double angle_degrees, double radius) {
  Skeleton skeleton = junction({{0, 0, 0.95}, {angle_degrees, 0, radius}});
  skeleton.internodes[1].order = 0;
  skeleton.internodes[2].order = 1;
  return skeleton;
}

Skeleton cut_at(const Skeleton& skeleton, double position, double tilt_degrees, double splinters = 0) {
  CutRule rule;
  rule.branches.order = {1, 1};
  rule.position = position;
  rule.tilt_degrees = tilt_degrees;
  rule.splinters = splinters;
  return prune(skeleton, {&rule, 1}, {});
}

struct Variant {
  JointKind joint;
  JunctionKind junction;
};
const Variant kVariants[] = {{JointKind::kFaded, JunctionKind::kRidge},
                             {JointKind::kFaded, JunctionKind::kSmooth},
                             {JointKind::kPaper, JunctionKind::kRidge},
                             {JointKind::kPaper, JunctionKind::kSmooth}};

TreeOptions options_of(const Variant& variant) {
  TreeOptions options;
  options.joint = variant.joint;
  options.junction = variant.junction;
  return options;
}

Skeleton scarred(const Skeleton& skeleton, const ScarShape& shape) {
  ScarRule rule;
  rule.branches.order = {1, 1};
  rule.shape = shape;
  return prune(skeleton, {}, {&rule, 1});
}

// The surface's height along a line, from outside.
double height_of_surface(const Field& field, const Vec3& origin, const Vec3& direction, double from) {
  double outside = from;
  while (!is_inside(field, origin + outside * direction)) outside -= 1e-3;
  double inside = outside;
  outside += 1e-3;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + outside);
    (is_inside(field, origin + middle * direction) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

TEST_CASE("a cut's face is plane to the bark, near the trunk and far from it") {
  for (const Variant& variant : kVariants) {
    for (const double position : {0.19, 0.3, 0.6}) {
      for (const double tilt : {0.0, 25.0, -40.0, 60.0}) {
        const Skeleton left = cut_at(with_lateral(65, 0.5), position, tilt);
        const auto field = reference_field(tree_from_skeleton(left, options_of(variant)));
        const CutEnd& end = left.cut_ends.at(0);
        const Internode& cut = left.internodes[static_cast<std::size_t>(end.internode)];
        Vec3 x, y;
        complete_frame(end.normal, x, y);
        CAPTURE(variant.joint == JointKind::kPaper, variant.junction == JunctionKind::kRidge, position, tilt);
        int off = 0;
        for (int i = -9; i <= 9; ++i) {
          for (int k = -9; k <= 9; ++k) {
            const Vec3 p = cut.tip + 0.05 * (static_cast<double>(i) * x + static_cast<double>(k) * y);
            if (glm::distance(p, cut.tip) > 0.45 || p.x < 1.05) continue;
            off += !is_inside(*field, p - 1e-6 * end.normal) || is_inside(*field, p + 1e-6 * end.normal);
          }
        }
        CHECK(off == 0);
      }
    }
  }
}

TEST_CASE("a cut takes nothing but its branch") {
  for (const Variant& variant : kVariants) {
    const Skeleton whole = with_lateral(65, 0.5), left = cut_at(whole, 0.25, 20);
    const TreeOptions options = options_of(variant);
    const auto before = reference_field(tree_from_skeleton(whole, options)),
               after = reference_field(tree_from_skeleton(left, options));
    // The trunk by itself; the lateral is thought of for its joints.
    Skeleton bare = whole;
    bare.internodes[2].tip = bare.internodes[2].base + 1e-3 * (bare.internodes[2].tip - bare.internodes[2].base);
    const CutEnd& end = left.cut_ends.at(0);
    const Vec3 tip = left.internodes[2].tip;
    RandomSource random(3);
    int behind = 0, beyond = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 p = random.in_box({Vec3(-2, -2, -2), Vec3(5, 5, 2)});
      if (glm::dot(p - tip, end.normal) < 0) {
        wrong += is_inside(*before, p) != is_inside(*after, p);
        ++behind;
        continue;
      }
      ++beyond;
      // Beyond, the trunk stays and all that is nearer to it than to the lateral's own surface goes.
      if (std::hypot(p.x, p.z) < 0.93) wrong += is_inside(*before, p) != is_inside(*after, p);
      if (std::hypot(p.x, p.z) > 1.3) wrong += is_inside(*after, p);
    }
    CAPTURE(variant.joint == JointKind::kPaper, variant.junction == JunctionKind::kRidge);
    CHECK(wrong == 0);
    CHECK(behind > 1000);
    CHECK(beyond > 1000);
  }
}

TEST_CASE("a torn break is rough, no higher than its splinters, and solid below its plane") {
  const Skeleton left = cut_at(with_lateral(90, 0.5), 0.5, 0, 3);
  const auto field = reference_field(tree_from_skeleton(left));
  const Vec3 tip = left.internodes[2].tip, axis(1, 0, 0);
  double lowest = 10, highest = 0;
  for (int i = -8; i <= 8; ++i) {
    for (int k = -8; k <= 8; ++k) {
      const Vec3 p = tip + 0.05 * Vec3(0, i, k);
      if (glm::distance(p, tip) > 0.4) continue;
      CHECK(is_inside(*field, p - 1e-6 * axis));
      const double height = height_of_surface(*field, p, axis, 3);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
  }
  CHECK(lowest < 0.3);
  CHECK(highest > 0.5);
  CHECK(highest < 3 * 0.5 + 0.1);
}

TEST_CASE("a scar's hollow has the stated depth and stub and does not reach past its width") {
  for (const Variant& variant : kVariants) {
    for (const ScarShape& shape : {ScarShape{1, 0.3, 0.3}, ScarShape{1.6, 0.5, 0}, ScarShape{0.8, 0.2, 1}}) {
      const TreeOptions options = options_of(variant);
      const Skeleton whole = with_lateral(90, 0.4);
      const auto field = reference_field(tree_from_skeleton(scarred(whole, shape), options));
      ScarShape filled = shape;
      filled.depth = 0;
      const auto stub = reference_field(tree_from_skeleton(scarred(whole, filled), options));
      Skeleton trunk;
      trunk.internodes = {whole.internodes[0], whole.internodes[1]};
      const auto bark = reference_field(tree_from_skeleton(trunk, options));
      CAPTURE(variant.joint == JointKind::kPaper, variant.junction == JunctionKind::kRidge, shape.width);
      // The lateral's axis leaves the bark on the x axis, where the bark's normal may lean a little.
      const double start = height_of_surface(*bark, Vec3(0), Vec3(1, 0, 0), 1.8);
      double f = 0;
      Vec3 gradient;
      const Vec3 foot(start, 0, 0);
      bark->values_and_gradients({&foot, 1}, {&f, 1}, {&gradient, 1});
      const Vec3 normal = -glm::normalize(gradient);
      const double top = height_of_surface(*stub, foot, normal, 1), floor = height_of_surface(*field, foot, normal, 1);
      CHECK(top == Approx(shape.stub * 0.4).margin(1e-6));
      CHECK(top - floor == Approx(shape.depth * 0.4).margin(1e-6));
      RandomSource random(7);
      int changed = 0;
      for (int i = 0; i < 5000; ++i) {
        const Vec3 p = random.in_box({foot - Vec3(0.7), foot + Vec3(0.7)});
        const Vec3 beside = p - foot - glm::dot(p - foot, normal) * normal;
        if (value(*field, p) == value(*stub, p)) continue;
        ++changed;
        CHECK(glm::length(beside) <= shape.width * 0.4 + 1e-12);
      }
      CHECK(changed > 20);
    }
  }
}

TEST_CASE("marks where they cannot be are refused") {
  Skeleton skeleton = with_lateral(60, 0.5);
  skeleton.cut_ends.push_back({0, Vec3(0, 1, 0), 0});
  CHECK_THROWS_AS(tree_from_skeleton(skeleton), InputError);
  skeleton.cut_ends.clear();
  skeleton.scars.push_back({7, {}});
  CHECK_THROWS_AS(tree_from_skeleton(skeleton), InputError);
}

TEST_CASE("the compiled field agrees with the reference on trees with missing organs, bends and tips") {
  int differing = 0, compared = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    std::vector<CutRule> cuts(2);
    cuts[0].branches.fraction = 0.3;
    cuts[0].tilt_degrees = 30;
    cuts[1].branches.fraction = 0.2;
    cuts[1].branches.seed = 1;
    cuts[1].splinters = 2;
    ScarRule scar;
    scar.branches.fraction = 0.3;
    scar.branches.seed = 2;
    for (CutRule& cut : cuts) cut.branches.order = {1, 9};
    TreeOptions options;
    options.bend_angle_degrees = seed % 2 ? 30 : 0;
    if (seed % 3 == 0) options.tips.push_back({});
    const BlobTree tree = tree_from_skeleton(prune(random_skeleton(seed, 25), cuts, {&scar, 1}), options);
    const auto fast = compile(tree), slow = reference_field(tree);
    RandomSource random(seed);
    for (int i = 0; i < 2000; ++i) {
      const Cone* cone = nullptr;
      const FadedCone* faded = nullptr;
      while (!cone && !faded) {
        const auto node = static_cast<std::size_t>(random.unit() * static_cast<double>(tree.nodes.size()));
        cone = std::get_if<Cone>(&tree.nodes[node].what);
        faded = std::get_if<FadedCone>(&tree.nodes[node].what);
      }
      const Vec3 near = cone ? cone->tip : faded->tip;
      const double reach = 3 * (cone ? cone->base_radius : faded->base_radius);
      const Vec3 p = near + random.in_box({Vec3(-reach), Vec3(reach)});
      const double expected = value(*slow, p);
      if (expected == 0) continue;
      ++compared;
      // Arcs of thousands of radii leave single precision few digits.
      differing += std::abs(value(*fast, p) - expected) > (options.bend_angle_degrees > 0 ? 1e-3 : 2e-5);
    }
  }
  CHECK(compared > 2000);
  CHECK(differing <= compared / 1000);
}
