#pragma once
// The surface cells of a compiled model: short cylinders around its branches.

#include "blobtree/field_model.h"
#include "blobtree/surface_cells.h"

namespace barkridge {

/// The cells of the model's part in a box: a few along each cone, around where it can lift the field to the iso-value
/// with the help of those that matter there. Made in parallel.
std::unique_ptr<const SurfaceCells> cells_of(std::shared_ptr<const FieldModel> model, const Box& region);

}  // namespace barkridge
