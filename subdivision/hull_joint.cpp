#include "subdivision/hull_joint.h"

#include <libqhull_r/libqhull_r.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "base/error.h"

namespace barkridge {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// The widest empty cap that the joint may have: half of its angle, as a cosine.
constexpr double kLeastFacetDistance = 0.173648;  // cos(80 degrees): wider than any ring
// Rings leave at most a few such caps.
constexpr int kMostCaps = 64;
// Every round halves the edges of sails.
constexpr int kMostSailRounds = 6;

// Qhull writes about what it finds even when it is content.
std::FILE* nowhere() {
  static const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/dev/null", "w"), &std::fclose);
  return file.get();
}

// One run of Qhull [BDH96], its memory freed at the end.
class Qhull {
 public:
  // `Qt`: facets with more than three vertices, as of symmetrical whorls, are cut into triangles.
  explicit Qhull(std::vector<Vec3>& points) {
    qh_zero(&qh_, nowhere());
    char command[] = "qhull Qt Pp";
    failed_ =
        qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), &points[0].x, False, command, nullptr, nowhere()) != 0;
  }
  ~Qhull() {
    qh_freeqhull(&qh_, !qh_ALL);
    int left = 0, bytes = 0;
    qh_memfreeshort(&qh_, &left, &bytes);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  // Counter-clockwise from outside, in an order that only the points decide; none if Qhull gave up.
  Triangles triangles() {
    Triangles found;
    if (failed_) return found;
    qhT* const qh = &qh_;
    facetT* facet;
    FORALLfacets {
      std::array<std::uint32_t, 3> corners{};
      int count = 0;
      vertexT *vertex, **vertexp;
      FOREACHvertex_(facet->vertices) {
        if (count == 3) return {};
        corners[static_cast<std::size_t>(count++)] = static_cast<std::uint32_t>(qh_pointid(qh, vertex->point));
      }
      if (count < 3) return {};
      if (facet->toporient ^ qh_ORIENTclock) std::swap(corners[0], corners[1]);
      found.push_back(corners);
    }
    return found;
  }

 private:
  qhT qh_;
  bool failed_ = false;
};

// The triangles' planes that the unit sphere sticks out of the most, through the middle of the widest empty cap.
struct EmptyCap {
  Vec3 middle{0};
  double distance = 1;  // of the plane from the centre
};
EmptyCap widest_empty_cap(const std::vector<Vec3>& points, const Triangles& triangles) {
  EmptyCap widest;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 normal = glm::cross(points[b] - points[a], points[c] - points[a]);
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    const double distance = glm::dot(normal, points[a]) / length;
    if (distance < widest.distance) widest = {normal / length, distance};
  }
  return widest;
}

// Whether the hull is the whole sphere and has every pole's fan.
bool is_whole(const std::vector<Vec3>& points, const Triangles& triangles, std::size_t rings, int ring_vertices) {
  if (triangles.size() != 2 * points.size() - 4) return false;
  std::vector<int> fans(rings, 0);
  const auto n = static_cast<std::uint32_t>(ring_vertices);
  const auto first_pole = static_cast<std::uint32_t>(rings) * n;
  for (const auto& [a, b, c] : triangles) {
    if (!(glm::dot(points[a], glm::cross(points[b], points[c])) > 0)) return false;
    for (const auto& [pole, from, to] : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
      if (pole < first_pole || pole >= first_pole + rings) continue;
      const std::uint32_t ring = pole - first_pole;
      if (from / n != ring || to / n != ring) return false;
      const std::uint32_t step = (to + n - from) % n;
      if (step != 1 && step != n - 1) return false;
      ++fans[ring];
    }
  }
  return std::all_of(fans.begin(), fans.end(), [&](int count) { return count == ring_vertices; });
}

double radius_of(const HullRing& ring) { return ring.distance * std::tan(ring.angle); }

// How far the branches reach from the centre in a direction outside of their rings.
double reach(std::span<const HullRing> rings, const Vec3& direction) {
  double farthest = 0;
  for (const HullRing& ring : rings) {
    const double cosine = glm::dot(direction, ring.axis);
    const double sine = cosine > 0 ? glm::length(direction - cosine * ring.axis) : 1;
    farthest = std::max(farthest, radius_of(ring) / sine);
  }
  return farthest;
}

// Whether a point is farther from a branch's axis than the joint may be.
bool is_beyond(const HullRing& ring, const Vec3& point) {
  const Vec3 from_axis = point - std::max(0.0, glm::dot(point, ring.axis)) * ring.axis;
  return glm::length(from_axis) > kJointReach * radius_of(ring);
}

// A vertex must not come so near to a ring that this is no face any more.
bool is_clear_of(const HullRing& ring, const Vec3& direction) {
  return std::acos(std::clamp(glm::dot(direction, ring.axis), -1.0, 1.0)) > ring.angle + 0.5 * ring.gap;
}

// The directions from the centre to the middles of edges that are beyond all branches' reach.
std::vector<Vec3> sail_middles(std::span<const HullRing> rings, const std::vector<Vec3>& places,
                               const Triangles& triangles) {
  std::vector<Vec3> middles;
  for (const auto& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      if (a > b) continue;  // the triangle on the other side has it
      const Vec3 middle = 0.5 * (places[a] + places[b]);
      const Vec3 direction = glm::normalize(middle);
      const auto beyond = [&](const HullRing& ring) { return is_beyond(ring, middle) && is_clear_of(ring, direction); };
      if (std::all_of(rings.begin(), rings.end(), beyond)) middles.push_back(direction);
    }
  }
  return middles;
}

}  // namespace

Vec3 ring_direction(const HullRing& ring, int j, int count) {
  const double turn = 2 * std::numbers::pi * j / count;
  return std::cos(ring.angle) * ring.axis +
         std::sin(ring.angle) * (std::cos(turn) * ring.side + std::sin(turn) * ring.forward);
}

HullJoint hull_joint(std::span<const HullRing> rings, int ring_vertices) {
  std::vector<Vec3> points;  // on the sphere, or nearly
  std::vector<Vec3> places;  // of the points, from the centre
  for (const HullRing& ring : rings) {
    for (int j = 0; j < ring_vertices; ++j) {
      points.push_back(ring_direction(ring, j, ring_vertices));
      places.push_back(ring.distance / std::cos(ring.angle) * points.back());
    }
  }
  // A ring's vertices lie in one plane, which Qhull would cut or merge with its neighbours as it likes. A pole barely
  // above the plane makes it a fan of strictly convex facets, low enough that none of their planes reaches another
  // ring.
  const auto first_pole = static_cast<std::uint32_t>(points.size());
  for (const HullRing& ring : rings) {
    const double height = 1e-3 * std::min(1.0, ring.gap / ring.angle);
    const double plane = std::cos(ring.angle);
    points.push_back(ring.axis * (plane + height * (1 - plane)));
    places.push_back(ring.distance * ring.axis);
  }
  const auto first_extra = static_cast<std::uint32_t>(points.size());
  const auto add = [&](const Vec3& direction) {
    points.push_back(direction);
    places.push_back(reach(rings, direction) * direction);
  };

  Triangles triangles;
  for (int caps = 0;; ++caps) {
    triangles = Qhull(points).triangles();
    const EmptyCap cap = widest_empty_cap(points, triangles);
    if (triangles.empty() || caps == kMostCaps || cap.distance >= kLeastFacetDistance) break;
    add(cap.middle);
  }
  if (!is_whole(points, triangles, rings.size(), ring_vertices)) {
    throw InputError("branches meet that are too thin, or too close to each other, for a joint in double precision");
  }
  for (int round = 0; round < kMostSailRounds; ++round) {
    const std::size_t before = points.size();
    for (const Vec3& middle : sail_middles(rings, places, triangles)) add(middle);
    if (points.size() == before) break;
    Triangles finer = Qhull(points).triangles();
    if (!is_whole(points, finer, rings.size(), ring_vertices)) {
      points.resize(before);
      places.resize(before);
      break;
    }
    triangles = std::move(finer);
  }
  HullJoint joint;
  joint.extra.assign(places.begin() + first_extra, places.end());
  for (auto triangle : triangles) {
    bool in_ring = false;
    for (std::uint32_t& corner : triangle) {
      in_ring = in_ring || (corner >= first_pole && corner < first_extra);
      if (corner >= first_extra) corner -= first_extra - first_pole;
    }
    if (!in_ring) joint.triangles.push_back(triangle);
  }
  return joint;
}

}  // namespace barkridge
