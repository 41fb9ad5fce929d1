#pragma once
// Bends at many points at once, for the instruction set that the machine has.

#include "blobtree/cone_kernels.h"
#include "blobtree/line_kernels.h"
#include "blobtree/warp.h"

namespace barkridge {

/// Maps points to where they come from, relative to the origin that `to` names, in single precision like the cones.
void bend_points(const Warp::BendData& bend, double scale, const PointBatch& from, const PointBatch& to);

/// Ends of pieces of lines, relative to an origin, in units of the model.
struct alignas(64) PieceColumns {
  std::array<ConeColumns::Column, 3> from, to;
  Vec3 origin{0};  // in scene units; last, since columns are aligned
};

/// What a bend makes of pieces of lines, by lane.
struct alignas(64) BentPieces {
  LineColumns chords;  ///< relative to the bend's `straight_middle`; with slack for what the pieces are off them
  /// As WarpedPiece has them, in units of the model.
  ConeColumns::Column stretch, curvature, jump;
};

/// The pieces in the first `count` lanes.
void bend_pieces(const Warp::BendData& bend, double scale, const PieceColumns& pieces, std::size_t count,
                 BentPieces& bent);

/// Turns gradients of the child's field at the mapped points into those of the bent field at `points`.
void bend_gradients(const Warp::BendData& bend, double scale, const PointBatch& points, const FieldColumns& field);

}  // namespace barkridge
