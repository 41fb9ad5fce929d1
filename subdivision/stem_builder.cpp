#include "subdivision/stem_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/large_room.h"

namespace barkridge {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCornerAngle = 2 * kPi / kRingSize;

// The regular hexagon.
constexpr double kHalfRoot3 = std::numbers::sqrt3 / 2;
constexpr std::array<std::array<double, 2>, kRingSize> kCorners{
    {{1, 0}, {0.5, kHalfRoot3}, {-0.5, kHalfRoot3}, {-1, 0}, {-0.5, -kHalfRoot3}, {0.5, -kHalfRoot3}}};

// The place on a cylinder around the ring's axis that is nearest to a point: turns from the ring's first corner, and
// distance along the axis.
struct Unrolled {
  double turns, along;
};
Unrolled unrolled(const StemRing& ring, const Vec3& point) {
  const Vec3 from = point - ring.center;
  const double angle = std::atan2(glm::dot(from, ring.frame.binormal()), glm::dot(from, ring.frame.normal));
  return {angle / (2 * kPi), glm::dot(from, ring.frame.tangent)};
}

// The corners of a ring as a joint's templates number them. The branch that carries the others looks into the joint
// against their sense.
JointRing seen_from_branch(const StemRing& ring, const Vec3& normal, bool carrier) {
  const Frame front = frame_towards(carrier ? -ring.frame.tangent : ring.frame.tangent, normal);
  const Vec3 next_side = glm::cross(front.normal, front.tangent);
  const double sense = carrier ? 1 : -1;
  const double first = std::atan2(glm::dot(ring.frame.normal, next_side), glm::dot(ring.frame.normal, front.normal));
  // Where the corner nearest to the front is, in corners' angles.
  const double offset = first / kCornerAngle, phase = offset - std::round(offset);
  JointRing result;
  result.edge_forward = std::abs(phase) > 0.25;
  const double wanted = result.edge_forward ? 0.5 : 0;
  const auto start = static_cast<int>(std::lround(sense * (wanted - offset)));
  for (int i = 0; i < static_cast<int>(kRingSize); ++i) {
    const int corner = (start + static_cast<int>(sense) * i) % static_cast<int>(kRingSize);
    result.vertices[static_cast<std::size_t>(i)] =
        ring.first_vertex + static_cast<std::uint32_t>(corner < 0 ? corner + static_cast<int>(kRingSize) : corner);
  }
  return result;
}

}  // namespace

StemBuilder::StemBuilder(const Skeleton& skeleton, const Branches& branches, std::size_t max_rings,
                         const StemOptions& options)
    : skeleton_(skeleton), options_(options), longest_path_(std::max(branches.longest_path, 1e-300)) {
  if (!(options.radius_scale > 0) || !std::isfinite(options.radius_scale)) {
    throw InputError(fmt::format("radius_scale is {}: expected a finite number above 0", options.radius_scale));
  }
  // A cap adds a vertex; joints of unrolled texture add coordinates, three a triangle.
  const std::size_t vertices = max_rings * (kRingSize + 1);
  constexpr std::size_t kMostVertices = 400'000'000;
  if (vertices > kMostVertices) {
    throw LimitError(fmt::format("the control mesh may need {} vertices, more than {}: dress a part of the skeleton",
                                 vertices, kMostVertices));
  }
  reserve_large(mesh_.positions, vertices);
  reserve_large(mesh_.internodes, vertices);
  reserve_large(mesh_.triangles, 2 * vertices);
  reserve_large(mesh_.texture_triangles, 2 * vertices);
  reserve_large(mesh_.texture, vertices);
}

std::uint32_t StemBuilder::add_vertex(const Vec3& position, InternodeId internode) {
  mesh_.positions.emplace_back(position);
  mesh_.internodes.push_back(internode);
  return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

double StemBuilder::v_after(const StemRing& before, double radius, double distance) const {
  if (options_.texture == StemTexture::kReflected) return before.v + distance / longest_path_;
  return before.v + distance / (kPi * (before.radius + radius));
}

StemRing StemBuilder::add_ring(const AxisPoint& at, const Frame& frame, const StemRing* before, double distance) {
  StemRing ring{at.position, frame, at.radius * options_.radius_scale, 0, at.internode, 0, 0};
  if (before != nullptr) ring.v = v_after(*before, ring.radius, distance);
  ring.first_vertex = static_cast<std::uint32_t>(mesh_.positions.size());
  ring.first_texture = static_cast<std::uint32_t>(mesh_.texture.size());
  const Vec3 binormal = frame.binormal();
  for (std::uint32_t corner = 0; corner < kRingSize; ++corner) {
    const auto [x, y] = kCorners[corner];
    add_vertex(ring.center + ring.radius * (x * frame.normal + y * binormal), at.internode);
  }
  const auto v = static_cast<float>(ring.v);
  if (options_.texture == StemTexture::kReflected) {
    for (std::uint32_t corner = 0; corner < kRingSize; ++corner) {
      mesh_.texture.emplace_back(static_cast<float>(corner % 2), v);
    }
  } else {
    for (std::uint32_t corner = 0; corner <= kRingSize; ++corner) {
      mesh_.texture.emplace_back(static_cast<float>(corner) / kRingSize, v);
    }
  }
  return ring;
}

// `corner` may be one past the last, where the unrolled texture ends.
std::uint32_t StemBuilder::texture_at(const StemRing& ring, std::uint32_t corner) const {
  return ring.first_texture + (options_.texture == StemTexture::kReflected ? corner % kRingSize : corner);
}

void StemBuilder::add_wall(const StemRing& lower, const StemRing& upper) {
  for (std::uint32_t corner = 0; corner < kRingSize; ++corner) {
    const std::uint32_t next = (corner + 1) % kRingSize;
    const std::uint32_t a = lower.first_vertex + corner, b = lower.first_vertex + next;
    const std::uint32_t c = upper.first_vertex + next, d = upper.first_vertex + corner;
    mesh_.triangles.push_back({a, b, c});
    mesh_.triangles.push_back({a, c, d});
    const std::uint32_t ta = texture_at(lower, corner), tb = texture_at(lower, corner + 1);
    const std::uint32_t tc = texture_at(upper, corner + 1), td = texture_at(upper, corner);
    mesh_.texture_triangles.push_back({ta, tb, tc});
    mesh_.texture_triangles.push_back({ta, tc, td});
  }
}

void StemBuilder::crease_rim(const StemRing& ring) {
  for (std::uint32_t corner = 0; corner < kRingSize; ++corner) {
    mesh_.sharp_edges.push_back({{ring.first_vertex + corner, ring.first_vertex + (corner + 1) % kRingSize}});
  }
}

void StemBuilder::add_fan(const StemRing& ring, const Vec3& apex, bool at_tip) {
  const std::uint32_t vertex = add_vertex(apex, ring.internode);
  const double distance = std::max(ring.radius, glm::distance(apex, ring.center));
  const auto v = static_cast<float>(at_tip ? v_after(ring, ring.radius, distance)
                                           : 2 * ring.v - v_after(ring, ring.radius, distance));
  const bool reflected = options_.texture == StemTexture::kReflected;
  if (reflected) mesh_.texture.emplace_back(0.5F, v);
  for (std::uint32_t corner = 0; corner < kRingSize; ++corner) {
    const std::uint32_t next = (corner + 1) % kRingSize;
    const std::uint32_t a = ring.first_vertex + corner, b = ring.first_vertex + next;
    const std::uint32_t ta = texture_at(ring, corner), tb = texture_at(ring, corner + 1);
    if (!reflected) mesh_.texture.emplace_back((static_cast<float>(corner) + 0.5F) / kRingSize, v);
    const auto tip = static_cast<std::uint32_t>(mesh_.texture.size() - 1);
    mesh_.triangles.push_back(at_tip ? std::array{a, b, vertex} : std::array{b, a, vertex});
    mesh_.texture_triangles.push_back(at_tip ? std::array{ta, tb, tip} : std::array{tb, ta, tip});
  }
}

void StemBuilder::end_base(const StemRing& ring) {
  if (!options_.closed_base) return;
  add_fan(ring, ring.center, false);
  crease_rim(ring);
}

void StemBuilder::end_tip(const StemRing& ring, const Vec3& tip) {
  const bool tapered = options_.tip == StemTip::kTapered;
  add_fan(ring, tapered ? tip : ring.center, true);
  if (options_.tip == StemTip::kSharp) crease_rim(ring);
  if (tapered) mesh_.sharp_vertices.push_back({static_cast<std::uint32_t>(mesh_.positions.size() - 1)});
}

void StemBuilder::add_joint(std::span<const StemRing> rings, const Vec3& normal) {
  const std::size_t first_triangle = mesh_.triangles.size();
  std::vector<JointRing> seen;
  seen.reserve(rings.size());
  for (const StemRing& ring : rings) seen.push_back(seen_from_branch(ring, normal, &ring == rings.data()));
  triangulate_joint(seen, mesh_.positions, normal, mesh_.triangles);
  if (options_.texture == StemTexture::kCylindrical) return unroll_joint(rings, first_triangle);
  // Without seams there is one texture coordinate a vertex.
  for (std::size_t t = first_triangle; t < mesh_.triangles.size(); ++t) {
    mesh_.texture_triangles.push_back(mesh_.triangles[t]);
  }
}

void StemBuilder::unroll_joint(std::span<const StemRing> rings, std::size_t first_triangle) {
  std::vector<std::pair<std::uint32_t, const StemRing*>> starts;  // by first vertex
  starts.reserve(rings.size());
  for (const StemRing& ring : rings) starts.emplace_back(ring.first_vertex, &ring);
  std::sort(starts.begin(), starts.end());
  const auto ring_of = [&](std::uint32_t vertex) {
    return std::prev(std::upper_bound(starts.begin(), starts.end(), vertex,
                                      [](std::uint32_t v, const auto& start) { return v < start.first; }))
        ->second;
  };
  JointTexture known;
  for (std::size_t t = first_triangle; t < mesh_.triangles.size(); ++t) {
    const auto triangle = mesh_.triangles[t];
    // Triangles without a side on a ring go on with the first of their branches, the carrying one before all others.
    const StemRing* owner = std::min({ring_of(triangle[0]), ring_of(triangle[1]), ring_of(triangle[2])});
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      const StemRing* ring = ring_of(a);
      const double side = glm::distance(mesh_.positions[a], mesh_.positions[b]);
      if (ring != ring_of(b) || side <= longest) continue;
      longest = side;
      owner = ring;
    }
    unroll_triangle(*owner, triangle, known);
  }
}

void StemBuilder::unroll_triangle(const StemRing& owner, const std::array<std::uint32_t, 3>& triangle,
                                  JointTexture& known) {
  const auto on_ring = [&](std::uint32_t vertex) { return vertex - owner.first_vertex < kRingSize; };
  std::array<Unrolled, 3> places;
  std::array<double, 3> windings{};  // whole turns on top of the nearest place
  // All three on the same side of the seam, and the owner's corners where its wall has them.
  constexpr double kNone = 1e30;
  double least = kNone, least_on_ring = kNone;
  for (std::size_t i = 0; i < 3; ++i) {
    places[i] = unrolled(owner, Vec3(mesh_.positions[triangle[i]]));
    if (i > 0) windings[i] = std::round(places[0].turns - places[i].turns);
    places[i].turns += windings[i];
    least = std::min(least, places[i].turns);
    if (on_ring(triangle[i])) least_on_ring = std::min(least_on_ring, places[i].turns);
  }
  constexpr double kSeam = 1e-3;  // turns
  const double shift = std::floor((least_on_ring < kNone ? least_on_ring : least) + kSeam);
  std::array<std::uint32_t, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const double turns = places[i].turns - shift;
    const auto corner = static_cast<std::uint32_t>(std::max(0L, std::lround(turns * kRingSize)));
    if (on_ring(triangle[i]) && corner <= kRingSize && corner % kRingSize == triangle[i] - owner.first_vertex) {
      corners[i] = texture_at(owner, corner);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(mesh_.texture.size());
    const std::tuple key(owner.first_vertex, triangle[i], static_cast<int>(std::lround(windings[i] - shift)));
    corners[i] = known.emplace(key, next).first->second;
    if (corners[i] == next) mesh_.texture.emplace_back(turns, owner.v + places[i].along / (2 * kPi * owner.radius));
  }
  mesh_.texture_triangles.push_back(corners);
}

ControlMesh StemBuilder::take() {
  mesh_.ages = ages_of(mesh_.internodes, skeleton_);
  return std::move(mesh_);
}

}  // namespace barkridge
