#pragma once

#include "base/geometry.h"
#include "blobtree/field.h"

namespace barkridge {

/// A box around the solid of `field`, each side within 1/1000 of the support's diagonal of where the field's bounds
/// allow the solid to reach; empty if there is no solid. Explores only boxes that may hold the outermost point of a
/// side.
Box solid_bounds(const Field& field);

}  // namespace barkridge
