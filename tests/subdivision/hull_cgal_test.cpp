#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <catch2/catch.hpp>

#include "lsystem/limbs.h"
#include "subdivision/hull.h"
#include "subdivision/hull_graph.h"
#include "subdivision/hull_joint.h"
#include "tests/support/skeletons.h"
#include "tests/support/wild_skeleton.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

// Pairs of triangles that meet in more than what they share.
struct Intersections {
  std::size_t near = 0;  ///< of internodes that all meet in one point, or of one
  std::size_t far = 0;   ///< of limbs that cross
};

bool are_related(const Skeleton& skeleton, InternodeId a, InternodeId b) {
  const InternodeId up_a = skeleton.internodes[static_cast<std::size_t>(a)].parent;
  const InternodeId up_b = skeleton.internodes[static_cast<std::size_t>(b)].parent;
  return a == b || a == up_b || b == up_a || up_a == up_b;
}

Intersections intersections(const Skeleton& skeleton) {
  const ControlMesh mesh = hull_mesh(skeleton);
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const glm::vec3& p : mesh.positions) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
  for (const auto& t : mesh.triangles) {
    REQUIRE(surface.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) != Surface::null_face());
  }
  REQUIRE(CGAL::is_closed(surface));
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
  if (pairs.empty()) CHECK(CGAL::Polygon_mesh_processing::is_outward_oriented(surface));
  Intersections found;
  for (const auto& [first, second] : pairs) {
    bool near = true;
    for (const std::uint32_t a : mesh.triangles[first]) {
      for (const std::uint32_t b : mesh.triangles[second]) {
        near = near && are_related(skeleton, mesh.internodes[a], mesh.internodes[b]);
      }
    }
    ++(near ? found.near : found.far);
  }
  return found;
}

// What is left of a skeleton when joints without room have merged.
Skeleton merged(const Skeleton& skeleton) {
  const HullGraph graph = hull_graph(skeleton, HullOptions{}.thinnest_ring);
  Skeleton result;
  std::vector<InternodeId> place(graph.branches(), kNoInternode);
  for (std::size_t i = 0; i < graph.branches(); ++i) {
    if (graph.gone[i]) continue;
    place[i] = static_cast<InternodeId>(result.internodes.size());
    const std::uint32_t up = graph.up[i];
    result.internodes.push_back({graph.positions[up], graph.positions[i], graph.base_radii[i], graph.tip_radii[i],
                                 graph.is_base(up) ? kNoInternode : place[up]});
  }
  return result;
}

}  // namespace

TEST_CASE("CGAL finds no self-intersection in whorls, forks, or trunks with thin branches close to each other") {
  const auto check_none = [](const Skeleton& skeleton) {
    const Intersections found = intersections(skeleton);
    CHECK(found.near + found.far == 0);
  };
  for (const int count : {2, 3, 6, 8, 12}) {
    for (const double angle : {25.0, 60.0, 100.0}) check_none(fork(count, angle));
  }
  for (const double distance : {0.3, 0.6, 1.0, 3.0}) {
    Skeleton trunk = chain(distance, 10 * distance, 0);
    const auto count = static_cast<InternodeId>(trunk.internodes.size());
    for (InternodeId i = 0; i + 1 < count; ++i) {
      const Vec3 base = trunk.internodes[static_cast<std::size_t>(i)].tip;
      const double turn = i * 137.5 * kDegree;
      trunk.internodes.push_back({base, base + Vec3(4 * std::cos(turn), 2, 4 * std::sin(turn)), 0.1, 0.05, i, 1});
    }
    check_none(trunk);
  }
}

TEST_CASE(
    "CGAL finds no self-intersection in random trees whose limbs keep apart, and no other than of limbs in others") {
  std::size_t clean = 0, apart = 0, far = 0;
  constexpr int kTrees = 300;
  for (std::uint64_t seed = 0; seed < kTrees; ++seed) {
    INFO("seed " << seed);
    const Skeleton skeleton = random_skeleton(seed, 1 + static_cast<int>(seed) % 60);
    const Intersections found = intersections(skeleton);
    CHECK(found.near == 0);
    if (crossing_limbs(skeleton, kJointReach) == 0) {
      ++apart;
      CHECK(found.far == 0);
    }
    far += found.far;
    clean += found.far == 0;
  }
  WARN("limbs keep apart in " << apart << " of " << kTrees << " random trees; " << clean
                              << " do not intersect themselves; limbs that cross give the others " << far
                              << " pairs of triangles");
  CHECK(apart > kTrees / 3);
}

TEST_CASE("CGAL finds no sails between branches that leave a joint at very different distances") {
  // Before joints kept to their branches' reach, these did, into limbs that pass by.
  for (const std::uint64_t seed : {795, 3573, 5488, 5531}) {
    INFO("seed " << seed);
    const Skeleton skeleton = random_skeleton(seed, 1 + static_cast<int>(seed % 60));
    REQUIRE(crossing_limbs(skeleton) == 0);
    const Intersections found = intersections(skeleton);
    CHECK(found.near + found.far == 0);
  }
}

TEST_CASE("CGAL finds that even in skeletons that no plant has only limbs that cross after merging intersect") {
  std::size_t apart = 0, far = 0;
  constexpr int kSkeletons = 300;
  for (std::uint64_t seed = 0; seed < kSkeletons; ++seed) {
    INFO("seed " << seed);
    const Skeleton skeleton = wild_skeleton(seed);
    const Intersections found = intersections(skeleton);
    CHECK(found.near == 0);
    if (crossing_limbs(merged(skeleton), kJointReach) == 0) {
      ++apart;
      CHECK(found.far == 0);
    }
    far += found.far;
  }
  WARN("limbs keep apart in " << apart << " of " << kSkeletons << " wild skeletons; those that cross give " << far
                              << " pairs of triangles");
  CHECK(apart > kSkeletons / 20);
}
