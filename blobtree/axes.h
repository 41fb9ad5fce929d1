#pragma once
// The axes of a plant as curves, and how they end.

#include <vector>

#include "blobtree/from_skeleton.h"

namespace barkridge {

/// An internode's axis as an arc through its two ends, like `Bend`; straight with angle 0.
struct Arc {
  Vec3 direction{0};  ///< towards which it bulges, of length 1, across the chord
  double angle_degrees = 0;
};
/// The arc's tangents at the two ends of an internode, of length 1.
Vec3 start_tangent(const Internode& internode, const Arc& arc);
Vec3 end_tangent(const Internode& internode, const Arc& arc);

/// The arc's point at a share of its length.
Vec3 point_on(const Internode& internode, const Arc& arc, double share);

/// What primitives are made for.
struct Axes {
  Skeleton skeleton;
  std::vector<Arc> arcs;  ///< by internode; empty if all are straight
};

/// The axes of a skeleton. Internodes that need two arcs are halved, and tips are internodes more. Normals of cut ends
/// turn with the axes that they end. Cost: linear. Throws `InputError` for angles and lengths outside their ranges.
Axes axes_of(const Skeleton& skeleton, const TreeOptions& options);

/// Whether that is more than a copy.
bool shapes_axes(const TreeOptions& options);

}  // namespace barkridge
