#pragma once
// Where in space a ray can meet the solid.

#include <cstddef>
#include <memory>
#include <vector>

#include "base/progress.h"
#include "blobtree/field.h"

namespace barkridge {

/// A box that may hold part of the solid.
struct SurfaceCell {
  Box box;
  std::shared_ptr<const Field> field;  ///< the model, restricted to the box
  bool solid = false;                  ///< whether the whole box is inside
};

struct SurfaceCellOptions {
  /// Boxes are halved until the field cannot vary across one by more than this (its slope times the diagonal): the
  /// smaller, the closer cells fit the surface and the more of them there are.
  double max_variation = 2;
  /// Boxes smaller than this share of the whole are not halved.
  double min_relative_size = 1e-6;
  /// Halving stops when there are this many boxes.
  std::size_t max_cells = std::size_t{1} << 24;
  /// Asked between rounds whether to go on; always told 0.
  Progress progress;
};

/// Boxes with disjoint interiors that together hold the whole solid, each trimmed to what may be inside. Their order
/// and shape depend on field and options only. Cost: in proportion to the number of cells, shared by all threads.
std::vector<SurfaceCell> surface_cells(const Field& field, const SurfaceCellOptions& options = {});

}  // namespace barkridge
