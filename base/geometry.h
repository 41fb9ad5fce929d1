#pragma once
// Points, boxes, intervals and rays: the vocabulary of every room.
//
// Conventions of the whole program: right-handed coordinates, y is up, lengths in scene units, angles in radians unless
// a name ends in `_degrees`.

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace barkridge {

using Vec3 = glm::dvec3;
using Mat3 = glm::dmat3;

/// A closed range of numbers; empty when `lo > hi`.
struct Interval {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  bool empty() const { return lo > hi; }
  bool contains(double x) const { return lo <= x && x <= hi; }
};

/// An axis-aligned closed box; the default one is empty and the neutral element of `unite`.
struct Box {
  Vec3 lo{std::numeric_limits<double>::infinity()};
  Vec3 hi{-std::numeric_limits<double>::infinity()};

  bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  Vec3 center() const { return 0.5 * (lo + hi); }
  Vec3 half_extent() const { return 0.5 * (hi - lo); }
  /// Length of the diagonal; 0 for an empty box.
  double diagonal() const { return empty() ? 0.0 : glm::length(hi - lo); }
  bool contains(const Vec3& p) const {
    return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
  }
  bool overlaps(const Box& b) const {
    return lo.x <= b.hi.x && b.lo.x <= hi.x && lo.y <= b.hi.y && b.lo.y <= hi.y && lo.z <= b.hi.z && b.lo.z <= hi.z;
  }
};

inline Box unite(const Box& a, const Box& b) { return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)}; }
inline Box unite(const Box& a, const Vec3& p) { return {glm::min(a.lo, p), glm::max(a.hi, p)}; }
/// The common part of two boxes, empty when they do not meet.
inline Box intersect(const Box& a, const Box& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }
inline Box grown(const Box& b, double margin) { return {b.lo - Vec3(margin), b.hi + Vec3(margin)}; }

/// The points `origin + t * direction`, `t >= 0`; `direction` has length 1.
struct Ray {
  Vec3 origin{0};
  Vec3 direction{0, 0, -1};

  Vec3 at(double t) const { return origin + t * direction; }
};

/// The part of `range` in which the ray is inside the closed box; empty when there is none. Boxes that share a face get
/// intervals that share an end, so no gap opens between them.
inline Interval clip(const Ray& ray, const Box& box, Interval range) {
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis], direction = ray.direction[axis];
    if (direction == 0) {
      if (origin < box.lo[axis] || origin > box.hi[axis]) return {};
      continue;
    }
    const double a = (box.lo[axis] - origin) / direction;
    const double b = (box.hi[axis] - origin) / direction;
    range.lo = std::max(range.lo, std::min(a, b));
    range.hi = std::min(range.hi, std::max(a, b));
  }
  return range;
}

/// Two unit vectors that complete the unit vector `n` to a right-handed frame (t, b, n), continuous but for n.z = -1.
/// [Duff et al. 2017, "Building an Orthonormal Basis, Revisited"]
inline void complete_frame(const Vec3& n, Vec3& t, Vec3& b) {
  const double sign = n.z >= 0 ? 1.0 : -1.0;
  const double p = -1.0 / (sign + n.z);
  const double q = n.x * n.y * p;
  t = Vec3(1.0 + sign * n.x * n.x * p, sign * q, -sign * n.x);
  b = Vec3(q, sign + n.y * n.y * p, -n.y);
}

}  // namespace barkridge
