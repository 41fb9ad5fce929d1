#include "bark/branch_coordinates.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "bark/texture_mapping.h"
#include "blobtree/from_skeleton.h"
#include "blobtree/warp.h"
#include "tests/support/skeletons.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

BranchCoordinates coordinates_of(const Skeleton& skeleton, const PlantTree& plant) {
  return {plant.tree, skeleton, plant.primitives};
}

}  // namespace

TEST_CASE("along a straight chain all internodes agree about every point") {
  const Skeleton skeleton = chain(0.7, 7, 0.05);
  const PlantTree plant = plant_from_skeleton(skeleton);
  const BranchCoordinates coordinates = coordinates_of(skeleton, plant);
  for (std::size_t i = 1; i < plant.primitives.size(); ++i) {
    const BranchFrame &below = coordinates.of(plant.primitives[i - 1]), &above = coordinates.of(plant.primitives[i]);
    CHECK(above.internode == static_cast<InternodeId>(i));
    const Vec3 p(0.6, skeleton.internodes[i].base.y, -0.8);
    const BranchPoint a = branch_point(below, p), b = branch_point(above, p);
    CHECK(glm::distance(a.position, b.position) < 1e-12);
    CHECK(a.position.y == Approx(p.y));
    CHECK(std::hypot(a.position.x, a.position.z) == Approx(1));
    CHECK(a.around == Approx(b.around));
    CHECK(a.turns == Approx(b.turns));
    CHECK(a.radius == Approx(b.radius));
  }
}

TEST_CASE("turns are the integral of length over circumference") {
  Skeleton skeleton;
  skeleton.internodes.push_back({Vec3(0), Vec3(0, 3, 0), 0.5, 0.2});
  const PlantTree plant = plant_from_skeleton(skeleton);
  const BranchFrame frame = coordinates_of(skeleton, plant).of(plant.primitives[0]);
  double sum = 0;
  for (double y = 0.0005; y < 3; y += 0.001) sum += 0.001 / (kTurn * branch_point(frame, {0, y, 0.1}).radius);
  CHECK(branch_point(frame, {0, 3, 0.1}).turns == Approx(sum).epsilon(1e-6));
  CHECK(branch_point(frame, {0, -1, 0.1}).turns == Approx(-1 / (kTurn * 0.5)));
  CHECK(branch_point(frame, {0, 4, 0.1}).turns == Approx(sum + 1 / (kTurn * 0.2)).epsilon(1e-6));
}

TEST_CASE("directions around a branch turn with its axis by the least rotation") {
  // A curve in one plane: what points out of the plane keeps pointing there.
  Skeleton skeleton;
  Vec3 at(0);
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.12 * i;
    const Vec3 next = at + Vec3(std::sin(angle), std::cos(angle), 0);
    skeleton.internodes.push_back({at, next, 0.2, 0.2, i - 1});
    at = next;
  }
  for (const double bend : {0.0, 20.0}) {
    TreeOptions options;
    options.bend_angle_degrees = bend;
    const PlantTree plant = plant_from_skeleton(skeleton, options);
    const BranchCoordinates coordinates = coordinates_of(skeleton, plant);
    const Vec3 out(0, 0, 1);
    const Vec3 first = out * coordinates.of(plant.primitives[0]).axes;
    for (const NodeId primitive : plant.primitives) {
      CHECK(glm::distance(out * coordinates.of(primitive).axes, first) < 1e-9);
      CHECK(glm::determinant(coordinates.of(primitive).axes) == Approx(1));
    }
  }
}

TEST_CASE("the frames of bent internodes meet where their arcs do") {
  TreeOptions options;
  options.bend_angle_degrees = 35;
  const PlantTree plant = plant_from_skeleton(random_skeleton(11, 80), options);
  const Skeleton& skeleton = plant.skeleton;
  const BranchCoordinates coordinates = coordinates_of(skeleton, plant);
  std::vector<const Bend*> bends(plant.tree.nodes.size());
  for (const Node& node : plant.tree.nodes) {
    if (const Bend* bend = std::get_if<Bend>(&node.what)) bends[node.children[0]] = bend;
  }
  // Where a primitive's space has the point: through its bend, if it has one.
  const auto at = [&](InternodeId i, const Vec3& p) {
    const NodeId primitive = plant.primitives[static_cast<std::size_t>(i)];
    const Bend* bend = bends[primitive];
    return branch_point(coordinates.of(primitive), bend ? Warp(*bend, {Vec3(-9), Vec3(9)}).map(p) : p);
  };
  int compared = 0;
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    const Internode& internode = skeleton.internodes[i];
    if (internode.parent == kNoInternode) continue;
    const BranchPoint on_axis = at(static_cast<InternodeId>(i), internode.base);
    const BranchPoint from_parent = at(internode.parent, internode.base);
    CHECK(on_axis.position.y == Approx(from_parent.position.y));
    CHECK(on_axis.turns == Approx(from_parent.turns));
    // Off the axis, along the line that is across both tangents, the two agree to the first order.
    constexpr double kStep = 1e-6;
    const auto tangent = [&](InternodeId k) {
      Vec3 slope;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 step(0);
        step[axis] = kStep;
        slope[axis] = (at(k, internode.base + step).position.y - at(k, internode.base - step).position.y) / (2 * kStep);
      }
      return glm::normalize(slope);
    };
    const Vec3 side = glm::cross(tangent(static_cast<InternodeId>(i)), tangent(internode.parent));
    if (glm::length(side) < 1e-3) continue;
    const Vec3 p = internode.base + 1e-4 * glm::normalize(side);
    CHECK(at(static_cast<InternodeId>(i), p).around == Approx(at(internode.parent, p).around).margin(1e-3));
    ++compared;
  }
  CHECK(compared > 40);  // where chains go on, tangents are one
}

TEST_CASE("an image closes around a branch and keeps its size along it") {
  Skeleton skeleton = chain(1, 5, 0.1);
  const PlantTree plant = plant_from_skeleton(skeleton);
  const BranchCoordinates coordinates = coordinates_of(skeleton, plant);
  const TextureMapping mapping{0.5, 0.25, 0};
  for (std::size_t i = 0; i < plant.primitives.size(); ++i) {
    const BranchFrame& frame = coordinates.of(plant.primitives[i]);
    const double repeats = texture_repeats(mapping, frame);
    CHECK(repeats == std::round(repeats));
    CHECK(kTurn * frame.base_radius / repeats == Approx(0.5).epsilon(0.15));
    const Vec3 base = skeleton.internodes[i].base;
    BranchPoint left = branch_point(frame, base), right = left;
    left.around = -kTurn / 2;
    right.around = kTurn / 2;
    CHECK(texture_coordinates(mapping, frame, right).x - texture_coordinates(mapping, frame, left).x ==
          Approx(repeats));
    CHECK(texture_coordinates(mapping, frame, left).y == Approx(base.y / 0.25));
  }
}

TEST_CASE("an image that follows the radius keeps its shape") {
  const Skeleton skeleton = chain(1, 8, 0.1);
  const PlantTree plant = plant_from_skeleton(skeleton);
  const BranchCoordinates coordinates = coordinates_of(skeleton, plant);
  const TextureMapping mapping{1, 2, 1};
  for (const NodeId primitive : plant.primitives) {
    const BranchFrame& frame = coordinates.of(primitive);
    const Vec3 p = frame.base + 0.5 * frame.axes[1];
    const BranchPoint at = branch_point(frame, p), above = branch_point(frame, p + 1e-5 * frame.axes[1]);
    const double v_by_length =
        (texture_coordinates(mapping, frame, above).y - texture_coordinates(mapping, frame, at).y) / 1e-5;
    const double u_by_length = texture_repeats(mapping, frame) / (kTurn * at.radius);
    CHECK(texture_repeats(mapping, frame) == 6);
    CHECK(u_by_length / v_by_length == Approx(2).epsilon(1e-3));
  }
}
