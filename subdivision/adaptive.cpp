#include "subdivision/adaptive.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "base/error.h"
#include "subdivision/adaptive_closing.h"
#include "subdivision/adaptive_leaves.h"
#include "subdivision/to_mesh.h"

namespace barkridge {

namespace {

void check(const AdaptiveOptions& options) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError(fmt::format("expected {}, but it is {}", what, value));
  };
  require(options.max_angle_degrees > 0, "an angle above 0 between triangles", options.max_angle_degrees);
  require(options.min_area >= 0, "a least area >= 0", options.min_area);
  require(options.max_level >= 0 && options.max_level <= 16, "a highest level from 0 to 16", options.max_level);
}

// The result of a round, ready to be measured.
struct Candidate {
  const Leaves& leaves;
  const ClosedLeaves& closed;
  HalfEdges mesh;

  glm::dvec3 position(std::uint32_t v) const { return glm::dvec3(leaves.surface.positions[v]); }
  bool is_sharp(std::uint32_t h) const { return closed.pieces[h / 3].sharp[h % 3]; }
  // Whether the edge along `h` is a sharp crease or a boundary.
  bool is_crease(std::uint32_t h) const { return mesh.twin(h) == kNoHalfEdge || is_sharp(h); }

  glm::dvec3 normal(std::uint32_t t) const {
    const auto& [a, b, c] = mesh.triangles[t];
    return glm::cross(position(b) - position(a), position(c) - position(a));
  }
};

// The angle between two directions, 0 where one has no length.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

double dihedral_angle(const Candidate& candidate, std::uint32_t h) {
  if (candidate.is_crease(h)) return 0;
  return angle_between(candidate.normal(h / 3), candidate.normal(candidate.mesh.twin(h) / 3));
}

// By how much the crease or boundary through `v` turns there; 0 where none runs through.
double crease_turn(const Candidate& candidate, std::uint32_t v) {
  int count = 0;
  glm::dvec3 ends[2]{};
  around(candidate.mesh, v, [&](std::uint32_t h, std::uint32_t neighbour) {
    if (!candidate.is_crease(h)) return;
    if (count < 2) ends[count] = candidate.position(neighbour);
    ++count;
  });
  if (count != 2) return 0;
  return angle_between(candidate.position(v) - ends[0], ends[1] - candidate.position(v));
}

class Tolerance {
 public:
  Tolerance(const LoopLevel& coarse, const AdaptiveOptions& options)
      : coarse_(coarse), options_(options), angle_(options.max_angle_degrees * std::numbers::pi / 180) {}

  // Whether piece `t` meets a neighbour at too great an angle, or has part of a crease or boundary that turns too much.
  bool is_violated(const Candidate& candidate, std::uint32_t t) const {
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (dihedral_angle(candidate, h) > angle_) return true;
      if (!candidate.is_crease(h)) continue;
      for (const std::uint32_t v : {candidate.mesh.from(h), candidate.mesh.to(h)}) {
        if (!is_corner(v) && crease_turn(candidate, v) > angle_) return true;
      }
    }
    return false;
  }

  bool may_split(const Candidate& candidate, const Leaf& leaf) const {
    const glm::dvec3 a = candidate.position(leaf.vertices[0]);
    const glm::dvec3 normal =
        glm::cross(candidate.position(leaf.vertices[1]) - a, candidate.position(leaf.vertices[2]) - a);
    return leaf.level < options_.max_level && 0.5 * glm::length(normal) > options_.min_area;
  }

 private:
  // Coarse vertices keep their numbers.
  bool is_corner(std::uint32_t v) const { return coarse_.surface.sharpness_of_vertex(v) == kInfinitelySharp; }

  const LoopLevel& coarse_;
  const AdaptiveOptions& options_;
  double angle_;
};

// Which leaves are to be split.
std::vector<bool> find_violations(const Candidate& candidate, const Tolerance& tolerance) {
  const std::size_t piece_count = candidate.closed.pieces.size();
  std::vector<std::uint8_t> violated(piece_count, 0);
  tbb::parallel_for(std::size_t{0}, piece_count, [&](std::size_t t) {
    const Leaf& leaf = candidate.leaves.leaves[candidate.closed.pieces[t].leaf];
    violated[t] =
        tolerance.may_split(candidate, leaf) && tolerance.is_violated(candidate, static_cast<std::uint32_t>(t));
  });
  std::vector<bool> split(candidate.leaves.leaves.size(), false);
  for (std::size_t t = 0; t < piece_count; ++t) {
    if (violated[t] != 0) split[candidate.closed.pieces[t].leaf] = true;
  }
  return split;
}

// Adds leaves to what is to be split; returns how many there are.
std::size_t add_splits(const std::vector<Leaf>& leaves, const std::vector<bool>& split, TrianglesToSplit& to_split) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (!split[i]) continue;
    ++count;
    const auto level = static_cast<std::size_t>(leaves[i].level);
    if (to_split.size() <= level) to_split.resize(level + 1);
    to_split[level].push_back(leaves[i].number);
  }
  for (auto& level : to_split) std::sort(level.begin(), level.end());
  return count;
}

Mesh finish(Leaves leaves, const ClosedLeaves& closed) {
  Mesh surface = std::move(leaves.surface);
  for (const ClosedLeaves::Piece& piece : closed.pieces) {
    surface.triangles.push_back(piece.vertices);
    if (!surface.texture.empty()) surface.texture_triangles.push_back(piece.texture);
  }
  keep_attributes(surface, std::move(leaves.internodes), std::move(leaves.ages));
  return surface;
}

}  // namespace

Mesh subdivide_adaptively(const ControlMesh& mesh, const AdaptiveOptions& options) {
  check(options);
  check_triangle_count(mesh.triangles.size(), 0, options.loop);
  const LoopLevel coarse = coarse_level(mesh, options.loop);
  const Tolerance tolerance(coarse, options);
  TrianglesToSplit to_split;
  for (;;) {
    Leaves leaves = split_triangles(coarse, to_split);
    const ClosedLeaves closed = close_leaves(leaves);
    std::vector<HalfEdges::Triangle> triangles;
    triangles.reserve(closed.pieces.size());
    for (const ClosedLeaves::Piece& piece : closed.pieces) triangles.push_back(piece.vertices);
    const Candidate candidate{leaves, closed, half_edges(std::move(triangles), leaves.surface.positions.size())};
    const std::vector<bool> split = find_violations(candidate, tolerance);
    const std::size_t splits = add_splits(leaves.leaves, split, to_split);
    if (splits == 0) return finish(std::move(leaves), closed);
    check_triangle_count(closed.pieces.size() + 3 * splits, 0, options.loop);
  }
}

}  // namespace barkridge
