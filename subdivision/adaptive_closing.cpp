#include "subdivision/adaptive_closing.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include <glm/geometric.hpp>

namespace barkridge {

namespace {

using Piece = ClosedLeaves::Piece;

// A corner: vertex and texture coordinates.
struct Corner {
  std::uint32_t vertex, texture;
};

// A part of a leaf whose sides may yet be split.
struct Part {
  std::array<Corner, 3> corners;
  std::array<bool, 3> on_outline;  // whether side i is part of the leaf's; others are never split
  std::array<bool, 3> sharp;
};

// The same part with corner `i` first.
Part turned(const Part& part, std::size_t i) {
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  return {{part.corners[i], part.corners[j], part.corners[k]},
          {part.on_outline[i], part.on_outline[j], part.on_outline[k]},
          {part.sharp[i], part.sharp[j], part.sharp[k]}};
}

class LeafCloser {
 public:
  LeafCloser(const Leaves& leaves, std::vector<Piece>& pieces) : leaves_(leaves), pieces_(pieces) {}

  void close(std::uint32_t number) {
    const Leaf& leaf = leaves_.leaves[number];
    leaf_ = number;
    open_.push_back({{Corner{leaf.vertices[0], leaf.texture[0]}, Corner{leaf.vertices[1], leaf.texture[1]},
                      Corner{leaf.vertices[2], leaf.texture[2]}},
                     {true, true, true},
                     leaf.sharp});
    while (!open_.empty()) {
      const Part part = open_.back();
      open_.pop_back();
      divide(part);
    }
  }

 private:
  // The middle of side `i`, if it is split.
  bool middle(const Part& part, std::size_t i, Corner& result) const {
    const Corner &a = part.corners[i], &b = part.corners[(i + 1) % 3];
    if (!part.on_outline[i]) return false;
    result.vertex = leaves_.vertex_splits.find(a.vertex, b.vertex);
    if (result.vertex == Splits::kNone) return false;
    result.texture = leaves_.surface.texture.empty() ? 0 : leaves_.texture_splits.find(a.texture, b.texture);
    return true;
  }

  void divide(const Part& part) {
    std::array<Corner, 3> middles{};
    std::array<bool, 3> split{};
    for (std::size_t i = 0; i < 3; ++i) split[i] = middle(part, i, middles[i]);
    const auto count = std::count(split.begin(), split.end(), true);
    if (count == 0) return emit(part);
    if (count == 3) return divide_in_four(part, middles);
    // Turned so that the split side is first, or the two are.
    std::size_t first = 0;
    while (!split[first] || (count == 2 && !split[(first + 1) % 3])) ++first;
    const Part from_first = turned(part, first);
    if (count == 1) {
      divide_in_two(from_first, middles[first]);
    } else {
      divide_in_three(from_first, middles[first], middles[(first + 1) % 3]);
    }
  }

  void emit(const Part& part) {
    Piece piece;
    for (std::size_t i = 0; i < 3; ++i) {
      piece.vertices[i] = part.corners[i].vertex;
      piece.texture[i] = part.corners[i].texture;
    }
    piece.sharp = part.sharp;
    piece.leaf = leaf_;
    pieces_.push_back(piece);
  }

  void divide_in_two(const Part& p, const Corner& m) {
    const auto& [a, b, c] = p.corners;
    open_.push_back({{a, m, c}, {true, false, p.on_outline[2]}, {p.sharp[0], false, p.sharp[2]}});
    open_.push_back({{m, b, c}, {true, p.on_outline[1], false}, {p.sharp[0], p.sharp[1], false}});
  }

  void divide_in_three(const Part& p, const Corner& ab, const Corner& bc) {
    const auto& [a, b, c] = p.corners;
    open_.push_back({{ab, b, bc}, {true, true, false}, {p.sharp[0], p.sharp[1], false}});
    if (distance(a, bc) <= distance(ab, c)) {
      open_.push_back({{a, ab, bc}, {true, false, false}, {p.sharp[0], false, false}});
      open_.push_back({{a, bc, c}, {false, true, p.on_outline[2]}, {false, p.sharp[1], p.sharp[2]}});
    } else {
      open_.push_back({{a, ab, c}, {true, false, p.on_outline[2]}, {p.sharp[0], false, p.sharp[2]}});
      open_.push_back({{ab, bc, c}, {false, true, false}, {false, p.sharp[1], false}});
    }
  }

  void divide_in_four(const Part& p, const std::array<Corner, 3>& middles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t before = (i + 2) % 3;
      open_.push_back(
          {{p.corners[i], middles[i], middles[before]}, {true, false, true}, {p.sharp[i], false, p.sharp[before]}});
    }
    open_.push_back({middles, {false, false, false}, {false, false, false}});
  }

  float distance(const Corner& a, const Corner& b) const {
    const auto& positions = leaves_.surface.positions;
    return glm::length(positions[a.vertex] - positions[b.vertex]);
  }

  const Leaves& leaves_;
  std::vector<Piece>& pieces_;
  std::uint32_t leaf_ = 0;
  std::vector<Part> open_;
};

}  // namespace

ClosedLeaves close_leaves(const Leaves& leaves) {
  constexpr std::size_t kBlock = 4096;
  const std::size_t count = leaves.leaves.size();
  std::vector<std::vector<Piece>> blocks((count + kBlock - 1) / kBlock);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
    LeafCloser closer(leaves, blocks[block]);
    for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      closer.close(static_cast<std::uint32_t>(i));
    }
  });
  ClosedLeaves closed;
  for (const auto& block : blocks) closed.pieces.insert(closed.pieces.end(), block.begin(), block.end());
  return closed;
}

}  // namespace barkridge
