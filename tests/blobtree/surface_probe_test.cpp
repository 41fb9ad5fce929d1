#include "blobtree/surface_probe.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "blobtree/contact.h"
#include "blobtree/from_skeleton.h"
#include "blobtree/primitive.h"
#include "blobtree/solid_noise.h"
#include "blobtree/warp.h"
#include "tests/blobtree/random_trees.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// The whole tree, node by node, without boxes or programs: the contract of SurfaceSample in its own words.
struct Known {
  double value = 0;
  std::map<NodeId, double> weights;
  double deformation = 0, ridge = 0, cut = 0;
  NodeId cutter = 0;
};

NodeId heaviest(const Known& known) {
  NodeId found = known.cutter;
  double most = 0;
  for (const auto& [primitive, weight] : known.weights) {
    if (weight > most) {
      most = weight;
      found = primitive;
    }
  }
  return found;
}

class Oracle {
 public:
  explicit Oracle(const BlobTree& tree) : tree_(tree) {}
  Known at(const Vec3& p) const { return of(tree_.root, p); }

 private:
  Known of(NodeId id, const Vec3& p) const {
    return std::visit([&](const auto& what) { return of(what, id, p); }, tree_.nodes[id].what);
  }
  std::vector<Known> children(NodeId id, const Vec3& p) const {
    std::vector<Known> all;
    for (const NodeId child : tree_.nodes[id].children) all.push_back(of(child, p));
    return all;
  }

  template <typename What>
  Known of(const What& what, NodeId id, const Vec3& p) const {
    if constexpr (std::is_same_v<What, Bend>) {
      return of(tree_.nodes[id].children[0], Warp(what, {Vec3(-9), Vec3(9)}).map(p));
    } else if constexpr (std::is_constructible_v<Warp, What>) {
      return of(tree_.nodes[id].children[0], Warp(what).map(p));
    } else if constexpr (std::is_same_v<What, Displacement>) {
      Known known = of(tree_.nodes[id].children[0], p);
      const double factor = 1 + what.amount * sample(what.noise, p).value;
      known.value *= factor;
      known.deformation *= factor;
      return known;
    } else if constexpr (requires { join(what, children(id, p)); }) {
      return join(what, children(id, p));
    } else {
      Known known;
      known.value = sample(what, p).value;
      if (known.value > 0) known.weights[id] = 1;
      return known;
    }
  }

  static Known mixed(const std::vector<Known>& all, const std::vector<double>& weights) {
    Known result;
    double total = 0;
    for (std::size_t i = 0; i < all.size(); ++i) total += all[i].weights.empty() ? 0 : weights[i];
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const auto& [primitive, weight] : all[i].weights)
        if (weights[i] > 0) result.weights[primitive] += weights[i] * weight / total;
      result.ridge += weights[i] * all[i].ridge;
      result.cut += weights[i] * all[i].cut;
      if (weights[i] * all[i].cut > 0) result.cutter = all[i].cutter;
    }
    return result;
  }

  // Of what is to be added up; what is negative takes away.
  static Known added(const std::vector<Known>& all) {
    double positive = 0, negative = 0, lowest = 0;
    NodeId taker = 0;
    for (const Known& one : all) {
      (one.value > 0 ? positive : negative) += std::abs(one.value);
      if (one.value < lowest) {
        lowest = one.value;
        taker = heaviest(one);
      }
    }
    std::vector<double> weights;
    for (const Known& one : all) weights.push_back(one.value > 0 ? one.value / positive : 0);
    Known result = mixed(all, weights);
    for (const Known& one : all) {
      result.value += one.value;
      result.deformation += one.deformation;
    }
    if (std::min(1.0, negative / kIsoValue) > result.cut) {
      result.cut = std::min(1.0, negative / kIsoValue);
      result.cutter = taker;
    }
    return result;
  }

  static Known join(const Sum&, const std::vector<Known>& all) { return added(all); }
  static Known join(const Negative&, std::vector<Known> all) {
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (all[i].value < 0) all[i].weights.clear();
      all[i].value *= -1;
      all[i].deformation *= -1;
      all[i].ridge = all[i].cut = 0;
    }
    return added(all);
  }
  static Known join(const Ricci& ricci, const std::vector<Known>& all) {
    double powers = 0;
    for (const Known& one : all) powers += std::pow(std::max(0.0, one.value), ricci.exponent);
    if (powers == 0) return {};
    std::vector<double> weights;
    for (const Known& one : all) weights.push_back(std::pow(std::max(0.0, one.value), ricci.exponent) / powers);
    Known result = mixed(all, weights);
    result.value = std::pow(powers, 1 / ricci.exponent);
    for (const Known& one : all) {
      if (one.value > 0) result.deformation += std::pow(one.value / result.value, ricci.exponent - 1) * one.deformation;
    }
    return result;
  }
  static Known join(const Union&, const std::vector<Known>& all) {
    return *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  }
  static Known join(const Intersection&, const std::vector<Known>& all) {
    return *std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  }
  static Known join(const Difference&, const std::vector<Known>& all) {
    const Known& kept = all.front();
    const Known taken = join(Union{}, {all.begin() + 1, all.end()});
    const double complement =
        std::max(0.0, 1 - taken.value) + std::max(0.0, kept.value - 1) * std::max(0.0, 1 - taken.value / 0.5);
    if (taken.value <= 0 || kept.value <= complement) return kept;
    return {complement, kept.weights, 0, 0, 1, heaviest(taken)};
  }
  static Known join(const Contact& contact, const std::vector<Known>& all) {
    const auto dominating =
        std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    Known result = *dominating;
    double compression = 0, expansion = 0;
    for (auto one = all.begin(); one != all.end(); ++one) {
      if (one == dominating) continue;
      if (one->value >= 0.5) {
        compression += one->value - 0.5;
      } else {
        expansion += contact_expansion(contact.shape, 0.5 - one->value);
      }
      const bool within_crest = 0.5 - one->value <= contact.shape.width / 2;
      result.ridge = std::max(
          result.ridge, within_crest ? 1 : contact_expansion(contact.shape, 0.5 - one->value) / contact.shape.swelling);
    }
    if (compression > 0) result.value = std::max(0.5, result.value - compression);
    result.value += expansion;
    result.deformation += result.value - dominating->value;
    return result;
  }

  const BlobTree& tree_;
};

double weight_of(const SurfaceSample& sample, NodeId primitive) {
  double weight = 0;
  for (const SurfaceShare& share : sample.shares) weight += share.primitive == primitive ? share.weight : 0;
  return weight;
}

}  // namespace

TEST_CASE("a probe agrees with the whole tree on random trees of every kind of node") {
  int cuts = 0, deformed = 0, shared = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const BlobTree tree = random_tree(static_cast<std::uint64_t>(seed), 1 + seed % 25);
    const SurfaceProbe probe(tree);
    const Oracle oracle(tree);
    RandomSource random(500 + static_cast<std::uint64_t>(seed));
    SurfaceSample sample;
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = random.in_box({Vec3(-kTreeExtent), Vec3(kTreeExtent)});
      probe.at(p, sample);
      const Known known = oracle.at(p);
      CAPTURE(seed, p.x, p.y, p.z, known.value);
      // A tie may be decided either way; none is met but where fields are zero, and there nothing is asked.
      if (known.value <= 0) continue;
      REQUIRE(sample.deformation == Approx(known.deformation).margin(1e-9));
      REQUIRE(sample.ridge == Approx(known.ridge).margin(1e-9));
      REQUIRE(sample.cut == Approx(known.cut).margin(1e-9));
      if (known.cut > 0) REQUIRE(sample.cutter == known.cutter);
      double sum = 0;
      for (const SurfaceShare& share : sample.shares) {
        sum += share.weight;
        const auto found = known.weights.find(share.primitive);
        REQUIRE(found != known.weights.end());
        REQUIRE(share.weight == Approx(found->second).margin(1e-9));
      }
      if (!known.weights.empty()) REQUIRE(sum == Approx(1).margin(1e-9));
      cuts += sample.cut > 0;
      deformed += sample.deformation != 0;
      shared += sample.shares.size() > 1;
    }
  }
  CHECK(cuts > 50);
  CHECK(deformed > 100);
  CHECK(shared > 100);
}

TEST_CASE("a share's point is where warps bring it, and its Jacobian the limit of differences") {
  BlobTree tree;
  const NodeId cone = tree.add(Cone{{0, 0, 0}, {0, 2, 0}, 0.5, 0.4});
  tree.add(Twist{{0, 0, 0}, {0, 1, 0}, 40}, {cone});
  const Bend bend{{0, 0, 0}, {0, 2, 0}, {1, 0, 0}, 50};
  tree.add(bend, {tree.root});
  const SurfaceProbe probe(tree);
  const auto moved = [&](const Vec3& p) {
    return Warp(Twist{{0, 0, 0}, {0, 1, 0}, 40}).map(Warp(bend, {Vec3(-3), Vec3(3)}).map(p));
  };
  SurfaceSample sample;
  for (const Vec3 p : {Vec3(0.5, 1, 0.1), Vec3(0.2, 0.4, -0.3), Vec3(0.7, 1.2, 0.2)}) {
    probe.at(p, sample);
    REQUIRE(sample.shares.size() == 1);
    CHECK(glm::distance(sample.shares[0].point, moved(p)) < 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step(0);
      step[axis] = 1e-6;
      CHECK(glm::distance(sample.shares[0].jacobian[axis], (moved(p + step) - moved(p - step)) / 2e-6) < 1e-7);
    }
  }
}

TEST_CASE("two equal branches deform each other as the closed form says, and nothing where they are far apart") {
  BlobTree tree;
  const NodeId left = tree.add(Cone{{-0.8, -9, 0}, {-0.8, 9, 0}, 1, 1});
  const NodeId right = tree.add(Cone{{0.8, -9, 0}, {0.8, 9, 0}, 1, 1});
  const ContactShape shape{0.4, 0.1, false};
  tree.add(Contact{shape}, {left, right});
  const SurfaceProbe probe(tree);
  // The falloff of a capsule, by its distance over twice its radius.
  const auto field = [](double distance) {
    const double v = distance * distance / 4, t = std::max(0.0, 1 - v);
    return t * t * (1 - 4 * v / 9);
  };
  SurfaceSample sample;
  for (double x = -2.5; x <= 2.5; x += 0.013) {
    for (const double z : {0.0, 0.4, 0.9}) {
      const double to_left = std::hypot(x + 0.8, z), to_right = std::hypot(x - 0.8, z);
      const double near = field(std::min(to_left, to_right)), other = field(std::max(to_left, to_right));
      probe.at({x, 0, z}, sample);
      CAPTURE(x, z, near, other);
      if (other >= 0.5) {
        CHECK(sample.deformation == Approx(std::max(0.5, near - (other - 0.5)) - near).margin(1e-12));
        CHECK(sample.deformation <= 0);
        CHECK(sample.ridge == 1);
      } else {
        CHECK(sample.deformation == Approx(contact_expansion(shape, 0.5 - other)).margin(1e-12));
        if (other <= 0.1) CHECK(sample.deformation == 0);
        if (other <= 0.1) CHECK(sample.ridge == 0);
      }
      if (near > 0) CHECK(weight_of(sample, x < 0 ? left : right) == 1);
    }
  }
}

TEST_CASE("a cut shows what it was cut from, and names its cutter") {
  BlobTree tree;
  const NodeId trunk = tree.add(Cone{{0, 0, 0}, {0, 4, 0}, 1, 1});
  const NodeId saw = tree.add(Disc{{0, 4, 0}, {0, 1, 0}, 3, 1});
  tree.add(Difference{}, {trunk, saw});
  const SurfaceProbe probe(tree);
  SurfaceSample sample;
  probe.at({0.3, 3, 0.2}, sample);
  CHECK(sample.cut == 1);
  CHECK(sample.cutter == saw);
  REQUIRE(sample.shares.size() == 1);
  CHECK(sample.shares[0].primitive == trunk);
  probe.at({1, 1, 0}, sample);
  CHECK(sample.cut == 0);
}

TEST_CASE("the shares of a chain's joints add up to one and pass from parent to child without a jump") {
  const PlantTree plant = plant_from_skeleton(chain(1.5, 6, 0));
  const SurfaceProbe probe(plant.tree);
  SurfaceSample sample;
  std::vector<double> last;
  for (double y = 0; y < 6; y += 0.01) {
    probe.at({1, y, 0}, sample);
    std::vector<double> weights;
    double sum = 0;
    for (const NodeId primitive : plant.primitives) sum += weights.emplace_back(weight_of(sample, primitive));
    CHECK(sum == Approx(1));
    for (std::size_t i = 0; i < last.size(); ++i) CHECK(std::abs(weights[i] - last[i]) < 0.01);
    last = weights;
  }
}

TEST_CASE("an internode's primitive is the one that stands on its axis") {
  for (const double bend : {0.0, 30.0}) {
    TreeOptions options;
    options.bend_angle_degrees = bend;
    const PlantTree plant = plant_from_skeleton(random_skeleton(7, 60), options);
    const Skeleton& skeleton = plant.skeleton;
    CHECK(plant.tree == tree_from_skeleton(random_skeleton(7, 60), options));
    REQUIRE(plant.primitives.size() == skeleton.internodes.size());
    for (std::size_t i = 0; i < plant.primitives.size(); ++i) {
      const FadedCone& cone = std::get<FadedCone>(plant.tree.nodes[plant.primitives[i]].what);
      CHECK(cone.base == skeleton.internodes[i].base);
      CHECK(cone.base_radius == skeleton.internodes[i].base_radius);
    }
  }
}
