#pragma once
// Random BlobTrees with every kind of node, within about the box [-2, 2]^3.

#include "blobtree/tree.h"
#include "tests/support/random_source.h"

namespace barkridge::test {

inline constexpr double kTreeExtent = 2;

inline Node random_primitive(RandomSource& random) {
  const Box around{Vec3(-1), Vec3(1)};
  const auto radius = [&] { return random.uniform(0.1, 0.4); };
  const Vec3 a = random.in_box(around);
  switch (random.integer(0, 6)) {
    case 0:
      return {Cone{a, random.in_box(around), radius(), radius()}, {}};
    case 1:
      return {Cone{a, a, radius(), radius()}, {}};
    case 2:
      return {Disc{a, random.direction(), random.uniform(0.1, 0.6), radius()}, {}};
    case 3:
      return {Ring{a, random.direction(), random.uniform(0.2, 0.6), radius()}, {}};
    case 4: {
      const Vec3 u = random.direction(), v = glm::normalize(glm::cross(u, random.direction()));
      // An arrow head: not convex.
      return {Polygon{{a, a + 0.6 * u + 0.6 * v, a + 0.2 * u, a + 0.6 * u - 0.6 * v}, radius()}, {}};
    }
    default: {
      const double parent = random.chance(0.7) ? radius() : 0, child = random.chance(0.7) ? radius() : 0;
      return {FadedCone{a, a + random.uniform(0.1, 1.2) * random.direction(), radius(), radius(), parent, child}, {}};
    }
  }
}

inline Node random_operator(RandomSource& random) {
  const Vec3 a = random.in_box({Vec3(-1), Vec3(1)});
  const Vec3 d = random.direction();
  switch (random.integer(0, 12)) {
    case 0:
      return {Ricci{random.uniform(1, 6)}, {}};
    case 1:
      return {Union{}, {}};
    case 2:
      return {Intersection{}, {}};
    case 3:
      return {Difference{}, {}};
    case 4:
      return {Negative{}, {}};
    case 5:
    case 6: {
      const double w = random.uniform(0.2, 0.5);
      return {Contact{{w, random.uniform(w / 6, w / 3), false}}, {}};
    }
    case 7: {
      const Vec3 side = glm::cross(d, random.direction());
      return {Bend{a, a + 4.0 * d, side, random.uniform(5, 40)}, {}};
    }
    case 8:
      return {Twist{a, d, random.uniform(-60, 60)}, {}};
    case 9:
      return {Taper{a, a + random.uniform(0.5, 2) * d, random.uniform(0.6, 1.5)}, {}};
    case 10: {
      Mat3 linear(random.direction(), random.direction(), random.direction());
      return {Affine{Mat3(1) + 0.3 * linear, 0.3 * random.direction()}, {}};
    }
    case 11: {
      SolidNoise noise{random.uniform(0.1, 2), random.uniform(0.5, 8), random.integer(1, 4), random.chance(0.5)};
      noise.seed = random.integer(0, 1000);
      return {Displacement{random.uniform(0, 0.9), noise}, {}};
    }
    default:
      return {Sum{}, {}};
  }
}

/// Joins random nodes by random operators until one is left. `primitives` >= 1.
inline BlobTree random_tree(std::uint64_t seed, int primitives) {
  RandomSource random(seed);
  BlobTree tree;
  std::vector<NodeId> loose;
  for (int i = 0; i < primitives; ++i) loose.push_back(tree.add(random_primitive(random).what));
  const auto take = [&] {
    const std::size_t at = static_cast<std::size_t>(random.integer(0, static_cast<int>(loose.size()) - 1));
    const NodeId id = loose[at];
    loose.erase(loose.begin() + static_cast<std::ptrdiff_t>(at));
    return id;
  };
  while (loose.size() > 1) {
    Node node = random_operator(random);
    const bool has_one = std::holds_alternative<Displacement>(node.what) || std::holds_alternative<Bend>(node.what) ||
                         std::holds_alternative<Twist>(node.what) || std::holds_alternative<Taper>(node.what) ||
                         std::holds_alternative<Affine>(node.what);
    const int count = has_one ? 1 : random.integer(2, std::min<int>(4, static_cast<int>(loose.size())));
    for (int k = 0; k < count; ++k) node.children.push_back(take());
    loose.push_back(tree.add(node.what, node.children));
  }
  return tree;
}

}  // namespace barkridge::test
