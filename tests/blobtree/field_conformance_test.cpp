// What every Field promises, checked on every Field that this room makes.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <functional>

#include "blobtree/from_skeleton.h"
#include "tests/blobtree/random_trees.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

constexpr int kTrees = 120;

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || a == b; }

FieldBounds grown_by_rounding(FieldBounds b) {
  const double margin = 1e-12 * (1 + std::abs(b.value.lo) + std::abs(b.value.hi));
  return {{b.value.lo - margin, b.value.hi + margin}, b.slope * (1 + 1e-9) + 1e-9};
}

Box random_box(RandomSource& random, const Box& within) {
  const Vec3 a = random.in_box(within);
  const Vec3 extent = std::pow(10.0, random.uniform(-3, 0)) * Vec3(random.unit(), random.unit(), random.unit());
  return {a - extent, a + extent};
}

const Box kSpace{Vec3(-kTreeExtent), Vec3(kTreeExtent)};

struct Sample {
  double value;
  Vec3 gradient;
};
Sample at(const Field& field, const Vec3& p) {
  Sample s{};
  field.values_and_gradients({&p, 1}, {&s.value, 1}, {&s.gradient, 1});
  return s;
}

using Make = std::function<std::shared_ptr<const Field>(const BlobTree&)>;
struct Kind {
  std::string name;
  Make make;
  double step;       // of central differences: larger in single precision
  double tolerance;  // of gradients against them
};
const std::vector<Kind> kFields{{"reference", reference_field, 1e-6, 1e-5}, {"compiled", compile, 1e-3, 5e-3}};

}  // namespace

TEST_CASE("the compiled field agrees with the reference on random trees of every kind of node") {
  int compared = 0, differing = 0;
  for (int seed = 0; seed < kTrees; ++seed) {
    const BlobTree tree = random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 30);
    const auto reference = reference_field(tree), compiled = compile(tree);
    RandomSource random(1000 + static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = random.in_box(kSpace);
      const Sample r = at(*reference, p), c = at(*compiled, p);
      CAPTURE(seed, p.x, p.y, p.z, r.value, c.value);
      REQUIRE(std::abs(r.value - c.value) <= 1e-5 * (1 + std::abs(r.value)));
      // At a crease rounding may choose the other side's gradient.
      ++compared;
      differing += glm::distance(r.gradient, c.gradient) > 1e-3 * (1 + glm::length(r.gradient));
    }
  }
  CHECK(differing <= compared / 2000);
}

TEST_CASE("gradients are the limits of central differences") {
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    int compared = 0, kinks = 0;
    for (int seed = 0; seed < kTrees; ++seed) {
      const auto field = make(random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 20));
      RandomSource random(2000 + static_cast<std::uint64_t>(seed));
      for (int i = 0; i < 30; ++i) {
        const Vec3 p = random.in_box(kSpace);
        const Vec3 gradient = at(*field, p).gradient;
        // Two steps that agree show that no crease is near.
        const auto difference = [&](double h) {
          Vec3 d;
          for (int axis = 0; axis < 3; ++axis) {
            Vec3 step(0);
            step[axis] = h;
            d[axis] = (at(*field, p + step).value - at(*field, p - step).value) / (2 * h);
          }
          return d;
        };
        const Vec3 coarse = difference(2 * step_size), fine = difference(step_size);
        if (glm::distance(coarse, fine) > 0.1 * tolerance * (1 + glm::length(fine))) {
          ++kinks;
          continue;
        }
        ++compared;
        CAPTURE(name, seed, p.x, p.y, p.z, gradient.x, gradient.y, gradient.z, fine.x, fine.y, fine.z);
        REQUIRE(glm::distance(gradient, fine) <= tolerance * (1 + glm::length(fine)));
      }
    }
    CHECK(kinks < compared / 5);
  }
}

TEST_CASE("values alone and values with gradients agree to the bit, whatever the batch") {
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    for (int seed = 0; seed < 30; ++seed) {
      const auto field = make(random_tree(static_cast<std::uint64_t>(seed), 12));
      RandomSource random(3000 + static_cast<std::uint64_t>(seed));
      std::vector<Vec3> points(333);
      for (Vec3& p : points) p = random.in_box(kSpace);
      std::vector<double> values(points.size()), again(points.size());
      std::vector<Vec3> gradients(points.size());
      field->values(points, values);
      field->values_and_gradients(points, again, gradients);
      for (std::size_t i = 0; i < points.size(); ++i) {
        CAPTURE(name, seed, i);
        REQUIRE(same_bits(values[i], again[i]));
        REQUIRE(same_bits(values[i], at(*field, points[i]).value));
      }
    }
  }
}

TEST_CASE("bounds of a box hold at every point in it") {
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    for (int seed = 0; seed < kTrees; ++seed) {
      const auto field = make(random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 20));
      RandomSource random(4000 + static_cast<std::uint64_t>(seed));
      for (int b = 0; b < 40; ++b) {
        const Box box = random_box(random, kSpace);
        const FieldBounds bounds = grown_by_rounding(field->bounds(box));
        for (int i = 0; i < 12; ++i) {
          const Vec3 p = random.in_box(box);
          const Sample s = at(*field, p);
          CAPTURE(name, seed, b, s.value, bounds.value.lo, bounds.value.hi, bounds.slope);
          REQUIRE(bounds.value.contains(s.value));
          REQUIRE(glm::length(s.gradient) <= bounds.slope);
        }
      }
    }
  }
}

TEST_CASE("between two points a field is no higher than its second derivative's bound allows") {
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    int bounded = 0;
    for (int seed = 0; seed < kTrees; ++seed) {
      TreeOptions options;
      options.junction = seed % 2 ? JunctionKind::kRidge : JunctionKind::kSmooth;
      options.bend_angle_degrees = seed % 3 ? 0 : 30;
      options.displacement.amount = seed % 3 ? 0 : 0.3;
      options.displacement.ridged = seed % 2;
      const Skeleton skeleton = random_skeleton(static_cast<std::uint64_t>(seed), 2 + seed % 12);
      const auto field = make(tree_from_skeleton(skeleton, options));
      RandomSource random(8000 + static_cast<std::uint64_t>(seed));
      for (int b = 0; b < 60; ++b) {
        const Box box = random_box(random, field->support());
        const FieldBounds bounds = field->bounds(box);
        const double lowest_second = bounds.second.lo;
        if (!std::isfinite(lowest_second)) continue;
        ++bounded;
        for (int i = 0; i < 6; ++i) {
          const Vec3 p = random.in_box(box), q = random.in_box(box);
          const double h = glm::distance(p, q), t = random.uniform(0, 1);
          const double highest =
              std::max(at(*field, p).value, at(*field, q).value) - lowest_second * h * h / 8 + bounds.kink * h / 4;
          CAPTURE(name, seed, b, lowest_second, h);
          REQUIRE(at(*field, p + t * (q - p)).value <= highest + 2e-6);
        }
      }
    }
    CHECK(bounded > 200);
  }
}

TEST_CASE("cells hold the whole solid") {
  for (int seed = 0; seed < kTrees; ++seed) {
    const auto field = compile(random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 30));
    const auto cells = field->cells();
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < cells->size(); ++i) boxes.push_back(cells->box(i));
    RandomSource random(9000 + static_cast<std::uint64_t>(seed));
    std::vector<Vec3> points(2000);
    for (Vec3& p : points) p = random.in_box(kSpace);
    std::vector<double> values(points.size());
    field->values(points, values);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (values[i] < kIsoValue) continue;
      CAPTURE(seed, points[i].x, points[i].y, points[i].z, values[i]);
      REQUIRE(std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return box.contains(points[i]); }));
    }
  }
}

TEST_CASE("points that are no numbers do not keep the others from their values") {
  const auto field = compile(random_tree(3, 12));
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points{Vec3(none), Vec3(0.1), Vec3(1, none, 0), Vec3(-0.7, 0.2, 0.4)};
  std::vector<double> values(points.size());
  field->values(points, values);
  CHECK(values[1] == at(*field, points[1]).value);
  CHECK(values[3] == at(*field, points[3]).value);
}

TEST_CASE("bounds close in on the value as the box shrinks") {
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    for (int seed = 0; seed < kTrees; ++seed) {
      const auto field = make(random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 10));
      RandomSource random(5000 + static_cast<std::uint64_t>(seed));
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = random.in_box(kSpace);
        const FieldBounds bounds = field->bounds({p - Vec3(1e-7), p + Vec3(1e-7)});
        CAPTURE(name, seed, p.x, p.y, p.z);
        REQUIRE(bounds.value.hi - bounds.value.lo < 1e-2);
      }
    }
  }
}

TEST_CASE("a restricted field agrees with the whole one to the bit inside its box") {
  for (int seed = 0; seed < kTrees; ++seed) {
    const auto field = compile(random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 30));
    RandomSource random(6000 + static_cast<std::uint64_t>(seed));
    for (int b = 0; b < 30; ++b) {
      const Box box = random_box(random, kSpace);
      const auto part = field->restricted(box);
      const Box smaller{box.lo + 0.2 * (box.hi - box.lo), box.hi - 0.3 * (box.hi - box.lo)};
      const auto part_of_part = part->restricted(smaller);
      REQUIRE(part->primitive_count() <= field->primitive_count());
      for (int i = 0; i < 12; ++i) {
        const Vec3 p = random.in_box(smaller);
        const Sample whole = at(*field, p), some = at(*part, p), less = at(*part_of_part, p);
        CAPTURE(seed, b, whole.value, some.value, less.value);
        REQUIRE(whole.value == some.value);
        REQUIRE(whole.value == less.value);
        REQUIRE(whole.gradient == some.gradient);
        REQUIRE(whole.gradient == less.gradient);
      }
    }
  }
}

TEST_CASE("a field is zero outside its support") {
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    for (int seed = 0; seed < kTrees; ++seed) {
      const auto field = make(random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 8));
      const Box support = field->support();
      RandomSource random(7000 + static_cast<std::uint64_t>(seed));
      for (int i = 0; i < 300; ++i) {
        const Vec3 p = random.in_box({Vec3(-4), Vec3(4)});
        if (support.contains(p)) continue;
        CAPTURE(name, seed, p.x, p.y, p.z);
        REQUIRE(at(*field, p).value == 0);
      }
    }
  }
}

TEST_CASE("an empty tree is the zero field") {
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    const auto field = make(BlobTree{});
    CHECK(field->support().empty());
    CHECK(field->primitive_count() == 0);
    CHECK(at(*field, Vec3(1, 2, 3)).value == 0);
    CHECK(field->bounds({Vec3(0), Vec3(1)}).value.hi == 0);
  }
}

TEST_CASE("a million nested nodes evaluate") {
  const int depth = 1'000'000;
  BlobTree tree;
  NodeId top = tree.add(Cone{Vec3(0), Vec3(0), 1, 1});
  for (int i = 0; i < depth; ++i) top = i % 2 ? tree.add(Sum{}, {top}) : tree.add(Union{}, {top});
  const Vec3 p(1, 0, 0);
  for (const auto& [name, make, step_size, tolerance] : kFields) {
    CAPTURE(name);
    CHECK(at(*make(tree), p).value == Approx(kIsoValue));
  }
  CHECK(barkridge::depth(tree) == static_cast<std::size_t>(depth) + 1);
}

TEST_CASE("a chain of a hundred thousand contacts needs no deep stack") {
  BlobTree tree;
  const int length = 100'000;
  NodeId top = tree.add(Cone{Vec3(0, length, 0), Vec3(0, length + 1, 0), 0.4, 0.4});
  for (int i = length - 1; i >= 0; --i) {
    const NodeId lateral = tree.add(Cone{Vec3(0, i, 0), Vec3(1, i + 1, 0), 0.2, 0.2});
    const NodeId contact = tree.add(Contact{}, {lateral, top});
    top = tree.add(Sum{}, {contact, tree.add(Cone{Vec3(0, i, 0), Vec3(0, i + 1, 0), 0.4, 0.4})});
  }
  const auto reference = reference_field(tree), compiled = compile(tree);
  for (const double y : {0.5, 777.25, 99999.0}) {
    const Vec3 p(0.35, y, 0.1);
    CHECK(at(*compiled, p).value == Approx(at(*reference, p).value).margin(1e-9));
  }
}

TEST_CASE("fields of rings and of polygons that are not convex may bend up without bound, those of discs may not") {
  const Box around{Vec3(-0.5), Vec3(0.5)};
  BlobTree ring, disc;
  ring.add(Ring{{0, 0, 0}, {0, 1, 0}, 1, 0.8});
  disc.add(Disc{{0, 0, 0}, {0, 1, 0}, 1, 0.8});
  // Across the axis of a ring the nearest place jumps to the other side.
  CHECK(std::isinf(compile(ring)->bounds(around).second.hi));
  CHECK(std::isinf(reference_field(ring)->bounds(around).second.hi));
  CHECK(std::isfinite(compile(disc)->bounds(around).second.hi));
}
