#include "subdivision/ring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace barkridge {

namespace {

// A dart's ring is within 0.66^n of its limit after n steps, and as near to flat after half as many.
constexpr int kDartSteps = 50, kDartNormalSteps = 20;

double decayed(double sharpness) { return sharpness > 1 ? sharpness - 1 : 0.0; }

enum class Rule { smooth, crease, corner };

// What a vertex is, and the neighbours along its crease if it is one.
struct Kind {
  Rule rule = Rule::smooth;
  int sharp_edges = 0;
  std::array<std::size_t, 2> crease{};
};

// The kind after `steps` steps, which may be 0 or 1.
template <class Value>
Kind kind_of(const VertexRing<Value>& ring, int steps) {
  const auto sharp = [&](double sharpness) { return steps == 0 ? sharpness > 0 : sharpness > 1; };
  Kind kind;
  for (std::size_t i = 0; i < ring.neighbours.size(); ++i) {
    if (!sharp(ring.sharpness[i])) continue;
    if (kind.sharp_edges < 2) kind.crease[static_cast<std::size_t>(kind.sharp_edges)] = i;
    ++kind.sharp_edges;
  }
  if (sharp(ring.center_sharpness) || kind.sharp_edges > 2) {
    kind.rule = Rule::corner;
  } else if (kind.sharp_edges == 2) {
    kind.rule = Rule::crease;
  }
  return kind;
}

template <class Value>
Value sum(const std::vector<Value>& values) {
  Value total(0);
  for (const Value& value : values) total += value;
  return total;
}

template <class Value>
Value by_rule(const VertexRing<Value>& ring, const Kind& kind) {
  if (kind.rule == Rule::corner) return ring.center;
  if (kind.rule == Rule::crease) {
    return 0.75 * ring.center + 0.125 * (ring.neighbours[kind.crease[0]] + ring.neighbours[kind.crease[1]]);
  }
  const auto valence = static_cast<double>(ring.neighbours.size());
  const double weight = neighbour_weight(ring.neighbours.size());
  return (1 - valence * weight) * ring.center + weight * sum(ring.neighbours);
}

// The mean of all sharpnesses that run out in this step, at most 1.
template <class Value>
double share_of_sharper_rule(const VertexRing<Value>& ring) {
  double total = 0;
  int count = 0;
  const auto add = [&](double sharpness) {
    if (sharpness <= 0 || sharpness > 1) return;
    total += sharpness;
    ++count;
  };
  add(ring.center_sharpness);
  for (const double sharpness : ring.sharpness) add(sharpness);
  return count == 0 ? 0.0 : total / count;
}

template <class Value>
bool is_semi_sharp(const VertexRing<Value>& ring) {
  const auto finite = [](double sharpness) { return sharpness > 0 && std::isfinite(sharpness); };
  return finite(ring.center_sharpness) || std::any_of(ring.sharpness.begin(), ring.sharpness.end(), finite);
}

template <class Value>
VertexRing<Value> after_sharpness(VertexRing<Value> ring) {
  while (is_semi_sharp(ring)) ring = refined(std::move(ring));
  return ring;
}

// The sum of the ring's triangles' normals, by area.
glm::dvec3 mean_normal(const VertexRing<glm::dvec3>& ring) {
  const std::size_t n = ring.neighbours.size();
  glm::dvec3 total(0);
  for (std::size_t i = 0; i + (ring.closed ? 0 : 1) < n; ++i) {
    total += glm::cross(ring.neighbours[i] - ring.center, ring.neighbours[(i + 1) % n] - ring.center);
  }
  return total;
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

// Cosine and sine of a turn by the angle between two neighbours of a smooth vertex.
glm::dvec2 turn_to_next(std::size_t valence) {
  if (valence == 6) return {0.5, 0.5 * std::numbers::sqrt3};
  const double angle = 2 * std::numbers::pi / static_cast<double>(valence);
  return {std::cos(angle), std::sin(angle)};
}

// From the left eigenvectors of the subdominant eigenvalue of a smooth ring, cosines and sines [HDD94].
glm::dvec3 smooth_normal(const VertexRing<glm::dvec3>& ring) {
  const glm::dvec2 turn = turn_to_next(ring.neighbours.size());
  glm::dvec2 weight(1, 0);
  glm::dvec3 u(0), v(0);
  for (const glm::dvec3& neighbour : ring.neighbours) {
    const glm::dvec3 side = neighbour - ring.center;  // the weights' sum is 0, and less is lost
    u += weight.x * side;
    v += weight.y * side;
    weight = {weight.x * turn.x - weight.y * turn.y, weight.x * turn.y + weight.y * turn.x};
  }
  return glm::cross(u, v);
}

// The normal of the fan of `count` triangles that starts at neighbour `first`, between two sharp edges at a crease.
// Along the crease the eigenvalue is 1/2. Across it, of `k` triangles, it is `3/8 + cos(pi / k) / 4`, of which the left
// eigenvector is `sin(i pi / k)` at the neighbours between; the entries at the crease and at the vertex follow from the
// columns of the ring's matrix. (For three triangles this is the well-known 2, 2; -1, -1; -2.) One triangle bends by
// the crease alone.
glm::dvec3 side_normal(const VertexRing<glm::dvec3>& ring, std::size_t first, std::size_t count) {
  // Weights' sums are 0, so sides may stand for neighbours, and 0 for the vertex.
  const auto side = [&](std::size_t i) { return ring.neighbours[(first + i) % ring.neighbours.size()] - ring.center; };
  const glm::dvec3 along = side(0) - side(count);
  if (count == 1) return glm::cross(along, side(0) + side(1));
  const double angle = std::numbers::pi / static_cast<double>(count), c = std::cos(angle), s = std::sin(angle);
  glm::dvec3 across = -s * c / ((1 - c) * (1 + 2 * c)) * (side(0) + side(count));
  for (std::size_t i = 1; i < count; ++i) across += std::sin(angle * static_cast<double>(i)) * side(i);
  return glm::cross(along, across);
}

glm::dvec3 crease_normal(const VertexRing<glm::dvec3>& ring, const Kind& kind) {
  const auto [first, last] = kind.crease;
  glm::dvec3 total = unit_or_zero(side_normal(ring, first, last - first));
  if (ring.closed) total += unit_or_zero(side_normal(ring, last, first + ring.neighbours.size() - last));
  return total;
}

template <class Value>
VertexRing<Value> refined_often(VertexRing<Value> ring, int steps) {
  for (int i = 0; i < steps; ++i) ring = refined(std::move(ring));
  return ring;
}

// Of a ring that is not semi-sharp; 0 at corners and where the surface has none.
glm::dvec3 sharp_limit_normal(const VertexRing<glm::dvec3>& ring) {
  const Kind kind = kind_of(ring, 0);
  if (kind.rule == Rule::corner) return glm::dvec3(0);
  if (kind.rule == Rule::crease) return crease_normal(ring, kind);
  if (kind.sharp_edges == 0) return smooth_normal(ring);
  return mean_normal(refined_often(ring, kDartNormalSteps));
}

}  // namespace

double neighbour_weight(std::size_t valence) {
  if (valence == 6) return 1.0 / 16;
  const auto n = static_cast<double>(valence);
  const double half = 3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4;
  return (5.0 / 8 - half * half) / n;
}

template <class Value>
Value refined_center(const VertexRing<Value>& ring) {
  const Kind before = kind_of(ring, 0), after = kind_of(ring, 1);
  const Value sharper = by_rule(ring, before);
  if (before.rule == Rule::smooth || before.rule == after.rule) return sharper;
  const double share = share_of_sharper_rule(ring);
  return share * sharper + (1 - share) * by_rule(ring, after);
}

template <class Value>
VertexRing<Value> refined(VertexRing<Value> ring) {
  const std::size_t n = ring.neighbours.size();
  const std::vector<Value> old = ring.neighbours;
  const Value center = refined_center(ring);
  for (std::size_t i = 0; i < n; ++i) {
    const Value middle = 0.5 * (ring.center + old[i]);
    const double sharp = std::min(ring.sharpness[i], 1.0);
    if (sharp < 1) {
      const Value smooth = 0.375 * (ring.center + old[i]) + 0.125 * (old[(i + n - 1) % n] + old[(i + 1) % n]);
      ring.neighbours[i] = sharp * middle + (1 - sharp) * smooth;
    } else {
      ring.neighbours[i] = middle;
    }
    ring.sharpness[i] = decayed(ring.sharpness[i]);
  }
  ring.center = center;
  ring.center_sharpness = decayed(ring.center_sharpness);
  return ring;
}

template <class Value>
Value limit_position(const VertexRing<Value>& ring) {
  if (is_semi_sharp(ring)) return limit_position(after_sharpness(ring));
  const Kind kind = kind_of(ring, 0);
  if (kind.rule == Rule::corner) return ring.center;
  if (kind.rule == Rule::crease) {
    return (4.0 * ring.center + ring.neighbours[kind.crease[0]] + ring.neighbours[kind.crease[1]]) / 6.0;
  }
  if (kind.sharp_edges == 1) return refined_often(ring, kDartSteps).center;
  const auto valence = static_cast<double>(ring.neighbours.size());
  const double weight = 1 / (valence + 3 / (8 * neighbour_weight(ring.neighbours.size())));
  return (1 - valence * weight) * ring.center + weight * sum(ring.neighbours);
}

glm::dvec3 limit_normal(const VertexRing<glm::dvec3>& ring) {
  const glm::dvec3 normal =
      unit_or_zero(is_semi_sharp(ring) ? sharp_limit_normal(after_sharpness(ring)) : sharp_limit_normal(ring));
  if (normal != glm::dvec3(0)) return normal;
  const glm::dvec3 mean = unit_or_zero(mean_normal(ring));
  return mean != glm::dvec3(0) ? mean : glm::dvec3(0, 1, 0);
}

template glm::dvec2 refined_center(const VertexRing<glm::dvec2>&);
template glm::dvec3 refined_center(const VertexRing<glm::dvec3>&);
template VertexRing<glm::dvec2> refined(VertexRing<glm::dvec2>);
template VertexRing<glm::dvec3> refined(VertexRing<glm::dvec3>);
template glm::dvec2 limit_position(const VertexRing<glm::dvec2>&);
template glm::dvec3 limit_position(const VertexRing<glm::dvec3>&);

}  // namespace barkridge
