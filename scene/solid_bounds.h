#pragma once
// Where the solid of a field ends, found by its bounds alone.

#include <optional>

#include "base/geometry.h"
#include "blobtree/field.h"

namespace barkridge {

/// The largest dot(direction, p) over all points p that the field's bounds cannot keep out of the solid, at most 1/1000
/// of what the support's diagonal gives too large; nothing if there is no solid. Looks only at boxes that may hold the
/// outermost point.
std::optional<double> solid_reach(const Field& field, const Vec3& direction);

/// The box of the six reaches along the axes; empty if there is no solid.
Box solid_bounds(const Field& field);

}  // namespace barkridge
