#pragma once

#include <cstddef>

#include "scene/pipeline.h"

namespace barkridge {

/// What a model consists of.
struct ModelStatistics {
  std::size_t internodes = 0, organs = 0, dropped_internodes = 0;
  std::size_t junctions = 0;  ///< internodes that carry several others, and roots that share their place
  std::size_t primitives = 0;
  std::size_t tree_nodes = 0;  ///< primitives and operators
  std::size_t tree_depth = 0;  ///< nodes on the longest way from the root to a primitive
  std::size_t bytes = 0;       ///< memory of skeleton and tree, estimated
};

/// Counts what the tree's root reaches. O(n), whatever the depth.
ModelStatistics statistics(const Model& model);

}  // namespace barkridge
