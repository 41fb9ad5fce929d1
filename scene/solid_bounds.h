#pragma once
// Where the solid of a field ends, found by its bounds alone.

#include <optional>

#include "base/geometry.h"
#include "blobtree/field.h"

namespace barkridge {

/// How far the solid reaches: the largest dot(direction, p) over its points p, as far as the field's bounds can tell,
/// within about a thousandth of the support's diagonal; nothing if there is no solid. Looks only at boxes that may hold
/// the outermost point, and at some ten thousand of them at the most.
std::optional<double> solid_reach(const Field& field, const Vec3& direction);

/// The box of the six reaches along the axes; empty if there is no solid.
Box solid_bounds(const Field& field);

}  // namespace barkridge
