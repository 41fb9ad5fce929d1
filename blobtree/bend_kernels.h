#pragma once
// Bends at many points at once, for the instruction set that the machine has.

#include "blobtree/cone_kernels.h"
#include "blobtree/warp.h"

namespace barkridge {

/// Maps points to where they come from, relative to the origin that `to` names, in single precision like the cones.
void bend_points(const Warp::BendData& bend, double scale, const PointBatch& from, const PointBatch& to);

/// Turns gradients of the child's field at the mapped points into those of the bent field at `points`.
void bend_gradients(const Warp::BendData& bend, double scale, const PointBatch& points, const FieldColumns& field);

}  // namespace barkridge
