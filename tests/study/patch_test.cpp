// A patch of a control mesh has the whole mesh's limit surface where it counts.

#include "study/patch.h"

#include <catch2/catch.hpp>
#include <map>
#include <tuple>

#include "base/random.h"
#include "subdivision/hull.h"
#include "subdivision/limit.h"

using namespace barkridge;

namespace {

// A stem with two forks.
Skeleton stem() {
  Skeleton skeleton;
  const auto add = [&](InternodeId parent, const Vec3& base, const Vec3& tip, double radius) {
    Internode internode;
    internode.base = base;
    internode.tip = tip;
    internode.base_radius = internode.tip_radius = radius;
    internode.parent = parent;
    skeleton.internodes.push_back(internode);
  };
  add(kNoInternode, {0, 0, 0}, {0, 2, 0}, 0.2);
  add(0, {0, 2, 0}, {1, 3, 0.3}, 0.15);
  add(0, {0, 2, 0}, {-1, 3.2, 0}, 0.14);
  add(1, {1, 3, 0.3}, {2, 3.4, 0}, 0.1);
  add(1, {1, 3, 0.3}, {1, 4, 1}, 0.1);
  return skeleton;
}

using Place = std::tuple<float, float, float>;
Place place_of(const glm::vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

TEST_CASE("a patch has the limit surface of the whole inside of its box") {
  const ControlMesh whole = hull_mesh(stem());
  const Mesh surface = limit_surface(whole, 2);
  int inside = 0;
  for (int k = 0; k < 20; ++k) {
    const Vec3 center(
        surface
            .positions[static_cast<std::size_t>(random_unit(4, k, 0) * static_cast<double>(surface.positions.size()))]);
    const Box box = grown({center, center}, 0.05 + 0.3 * random_unit(4, k, 1));
    const ControlMesh patch = patch_for(whole, box);
    CHECK(patch.triangles.size() <= whole.triangles.size());
    const Mesh part = limit_surface(patch, 2);
    std::map<Place, glm::vec3> known;
    for (std::size_t i = 0; i < part.positions.size(); ++i) known[place_of(part.positions[i])] = part.normals[i];
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
      if (!box.contains(Vec3(surface.positions[i]))) continue;
      // Sums around a vertex may start elsewhere, so the last digits may differ.
      float nearest = 1e9F, turn = 1e9F;
      for (const auto& [place, normal] : known) {
        const glm::vec3 p(std::get<0>(place), std::get<1>(place), std::get<2>(place));
        const float distance = glm::length(p - surface.positions[i]);
        if (distance >= nearest) continue;
        nearest = distance;
        turn = glm::length(normal - surface.normals[i]);
      }
      CHECK(nearest < 2e-6F);
      CHECK(turn < 1e-3F);
      ++inside;
    }
  }
  CHECK(inside > 500);
}

TEST_CASE("a patch of a small box is a small part") {
  const ControlMesh whole = hull_mesh(stem());
  const ControlMesh patch = patch_for(whole, grown({Vec3(2, 3.4, 0), Vec3(2, 3.4, 0)}, 0.01));
  CHECK(!patch.triangles.empty());
  CHECK(4 * patch.triangles.size() < whole.triangles.size());
  CHECK(patch_for(whole, grown({Vec3(9), Vec3(9)}, 1)).triangles.empty());
}
