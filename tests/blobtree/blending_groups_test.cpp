// Confined blending: that it changes nothing but what passes, from what whole subtrees give.

#include "blobtree/blending_groups.h"

#include <catch2/catch.hpp>

#include <set>

#include "blobtree/axes.h"
#include "blobtree/from_skeleton.h"
#include "blobtree/missing_organs.h"
#include "lsystem/prune.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// A random tree, perhaps with cuts and scars, and how it is to be made.
struct Case {
  Skeleton skeleton;
  TreeOptions options;
};

Case random_case(std::uint64_t seed) {
  RandomSource random(seed);
  Case result{random_skeleton(seed, 30), {}};
  if (random.chance(0.4)) {
    CutRule cut;
    cut.branches.order = {1, 9};
    cut.branches.fraction = 0.3;
    cut.tilt_degrees = random.uniform(-40, 40);
    cut.splinters = random.chance(0.5) ? 2 : 0;
    ScarRule scar;
    scar.branches = cut.branches;
    scar.branches.seed = 1;
    result.skeleton = prune(result.skeleton, {&cut, 1}, {&scar, 1});
  }
  TreeOptions& options = result.options;
  options.junction = random.chance(0.5) ? JunctionKind::kRidge : JunctionKind::kSmooth;
  options.joint = random.chance(0.2) ? JointKind::kPaper : JointKind::kFaded;
  options.bend_angle_degrees = random.chance(0.3) ? 25 : 0;
  if (random.chance(0.3)) options.tips.push_back({{}, TipKind::kBud});
  if (shapes_axes(options)) result.skeleton = axes_of(result.skeleton, options).skeleton;
  options.tips.clear();
  return result;
}

TreeOptions with(TreeOptions options, BlendingKind blending) {
  options.blending = blending;
  return options;
}

// The groups in which internodes stand: known by the internode that carries them, or by -1 for that of the ground.
class Groups {
 public:
  Groups(const Plant& plant, const std::vector<bool>& ends) : plant_(plant), ends_(ends) {}
  int at_base(std::size_t i) const {
    for (InternodeId at = plant_.internode(i).parent; at != kNoInternode;
         at = plant_.internode(static_cast<std::size_t>(at)).parent) {
      if (ends_[static_cast<std::size_t>(at)]) return at;
    }
    return -1;
  }
  int at_tip(std::size_t i) const { return ends_[i] ? static_cast<int>(i) : at_base(i); }

 private:
  const Plant& plant_;
  const std::vector<bool>& ends_;
};

struct Sample {
  double value = 0;
  Vec3 gradient{0};
};
Sample at(const Field& field, const Vec3& p) {
  Sample sample;
  field.values_and_gradients({&p, 1}, {&sample.value, 1}, {&sample.gradient, 1});
  return sample;
}

}  // namespace

TEST_CASE("beside internodes at which blending ends the field is that of whole subtrees, and so as smooth") {
  int compared = 0, in_both = 0, split = 0, inner = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    auto [skeleton, options] = random_case(seed);
    const BlobTree whole_tree = tree_from_skeleton(skeleton, with(options, BlendingKind::kSubtrees));
    const auto whole = reference_field(whole_tree), fast_whole = compile(whole_tree);
    const BlobTree confined_tree = tree_from_skeleton(skeleton, with(options, BlendingKind::kConfined));
    const auto confined = reference_field(confined_tree), fast = compile(confined_tree);

    std::vector<Arc> arcs;
    if (options.bend_angle_degrees > 0) arcs = axes_of(skeleton, options).arcs;
    const Plant plant(skeleton, arcs, options);
    BlobTree carved;
    const std::vector<bool> ends = ends_of_blending(plant, add_carvings(plant, carved).touched);
    const Groups groups(plant, ends);
    std::vector<std::shared_ptr<const Field>> alone(plant.size());
    for (std::size_t i = 0; i < plant.size(); ++i) {
      inner += !plant.children_of(i).empty();
      split += ends[i];
      if (plant.scar_of(i)) continue;
      BlobTree tree;
      tree.root = plant.add_primitive(tree, i);
      alone[i] = reference_field(tree);
    }

    RandomSource random(1000 + seed);
    for (int n = 0; n < 1500; ++n) {
      // Around an axis, also past its ends.
      const auto i = static_cast<std::size_t>(random.integer(0, static_cast<int>(plant.size()) - 1));
      if (!ends[i]) continue;
      const Internode& a = plant.internode(i);
      const double share = random.uniform(-0.2, 1.2);
      const Vec3 side = glm::normalize(glm::cross(a.tip - a.base, random.direction()));
      const Vec3 p = a.base + share * (a.tip - a.base) + random.uniform(0.9, 2.2) * a.base_radius * side;
      if (at(*alone[i], p).value <= 0) continue;
      bool only_neighbours = true, below = false, above = false;
      for (std::size_t k = 0; k < plant.size() && only_neighbours; ++k) {
        if (k == i || !alone[k] || at(*alone[k], p).value <= 0) continue;
        const std::set<int> its{groups.at_base(k), groups.at_tip(k)};
        const bool is_below = its.contains(groups.at_base(i)), is_above = its.contains(groups.at_tip(i));
        below = below || is_below;
        above = above || is_above;
        only_neighbours = is_below || is_above;
      }
      if (!only_neighbours) continue;  // something passes
      CAPTURE(seed, i, p.x, p.y, p.z);
      // What is smooth in between: never both.
      CHECK_FALSE((below && above));
      const Sample expected = at(*whole, p), found = at(*confined, p);
      if (expected.value >= kIsoValue) continue;  // deep in a contact the compressed and the whole may differ
      const double steep = glm::length(expected.gradient) + 1 / a.base_radius;
      CHECK(found.value == Approx(expected.value).margin(1e-9));
      CHECK(glm::distance(found.gradient, expected.gradient) < 1e-7 * steep);
      CHECK(at(*fast, p).value == Approx(at(*fast_whole, p).value).margin(1e-6));
      ++compared;
      in_both += below || above;
    }
  }
  CHECK(compared > 10'000);
  CHECK(in_both > 1'000);
  CHECK(split > inner / 5);
}

TEST_CASE("along an axis from which branches leave at small angles the surface has no crease") {
  // Internodes of 3 to 12 radii, with thin and thick branches that run beside them for long.
  for (const double length : {3.0, 4.5, 6.0, 8.0, 12.0}) {
    for (const double angle : {12.0, 20.0, 35.0, 60.0}) {
      for (const double radius : {0.15, 0.3, 0.6}) {
        Skeleton skeleton;
        for (int i = 0; i < 4; ++i) {
          const Vec3 base(0, i * length, 0), tip(0, (i + 1) * length, 0);
          skeleton.internodes.push_back({base, tip, 1, 1, i == 0 ? kNoInternode : 2 * (i - 1)});
          const double turn = angle * kDegree, around = (i % 2 ? 1.0 : -1.0);
          const Vec3 way(around * std::sin(turn), std::cos(turn), 0);
          skeleton.internodes.push_back({tip, tip + 30.0 * way, radius, radius, 2 * i, 1});
        }
        TreeOptions options;
        options.junction = JunctionKind::kSmooth;
        options.blending = BlendingKind::kConfined;
        const auto field = reference_field(tree_from_skeleton(skeleton, options));
        // No cone bends by more than 5 / R^2 + its fade's part, so the gradient moves by less than 100 a length. Where
        // branches of one side pass those of the other, past the axis's own support, there may be creases.
        const double step = 1e-3;
        CAPTURE(length, angle, radius);
        for (const double azimuth : {0.0, 30.0, 80.0, 180.0}) {
          for (const double distance : {0.95, 1.05, 1.3}) {
            const Vec3 side = distance * Vec3(std::cos(azimuth * kDegree), 0, std::sin(azimuth * kDegree));
            double sharpest = 0;
            Vec3 before = at(*field, side + Vec3(0, length, 0)).gradient;
            for (double y = length; y < 3 * length; y += step) {
              const Vec3 gradient = at(*field, side + Vec3(0, y, 0)).gradient;
              sharpest = std::max(sharpest, glm::distance(before, gradient));
              before = gradient;
            }
            CHECK(sharpest < 100 * step);
          }
        }
      }
    }
  }
}
