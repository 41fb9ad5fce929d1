#pragma once
// How the surface runs through one cell, for each of the 256 ways its corners can be inside or outside.
//
// Corner c of a cell has the offset (c & 1, c >> 1 & 1, c >> 2 & 1); bit c of a case says that it is inside. Edge e
// runs along axis e / 4 from the corner `edge_corner(e)`.

#include <array>
#include <cstdint>

namespace barkridge {

constexpr int edge_axis(int edge) { return edge / 4; }

/// The lower corner of an edge: the low two bits of the edge are its offsets along the other two axes, in cyclic order.
constexpr int edge_corner(int edge) {
  const int axis = edge_axis(edge);
  return (edge & 1) << ((axis + 1) % 3) | (edge >> 1 & 1) << ((axis + 2) % 3);
}

/// The surface's triangles, counter-clockwise from outside, each corner on the edge given.
struct CellCase {
  int triangle_count = 0;
  std::array<std::array<std::uint8_t, 3>, 5> triangles{};
};

/// Two neighbours always agree on the face between them, and no side of a triangle lies in a face but where the surface
/// crosses it. Hence, wherever on their edges the vertices are, the cells' triangles together make a closed, oriented
/// 2-manifold: a side inside a cell has its two triangles there, one in a face has one on each side of the face, and
/// each vertex is passed once by each of the four cells around its edge. Triangles of one cell never cross each other
/// either.
extern const std::array<CellCase, 256> kCellCases;

}  // namespace barkridge
