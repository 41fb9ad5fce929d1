#pragma once
// The lattice on which a field is sampled, and its blocks.

#include <glm/vec3.hpp>

#include "base/geometry.h"

namespace barkridge {

/// Cells along a block's side, and lattice points: those on its upper faces are also its neighbours'.
inline constexpr int kBlockCells = 8;
inline constexpr int kBlockPoints = kBlockCells + 1;

/// The points at integer multiples of `cell_size`. A point has the same coordinates to the bit from wherever it is
/// asked for.
struct Lattice {
  double cell_size = 1;
  /// Vertices stay this far away from their edge's ends: more than rounding to float can move them, so that rounded
  /// vertices still lie strictly within the edges of a lattice of rounded points. That keeps all of them apart and
  /// gives each triangle an area, since no three edges of a cell that are not all in one face meet a line in their
  /// insides.
  double margin = 0;

  Vec3 point(const glm::ivec3& index) const { return cell_size * Vec3(index); }
};

/// Blocks `lo` to `hi`, exclusive, along each axis. Block b has the cells from `kBlockCells * b` on.
struct BlockRange {
  glm::ivec3 lo{0};
  glm::ivec3 hi{0};
};

/// The closed box of all lattice points of the blocks.
Box box_of(const Lattice& lattice, const BlockRange& range);

/// A lattice fit for everything within `support`. Throws `InputError` for a size that is not positive and finite or too
/// small for the support's coordinates as floats, and for a support that is not bounded.
Lattice make_lattice(const Box& support, double cell_size);

}  // namespace barkridge
