#pragma once
// What cut ends and scars do to a plant's surface. [docs/field.md, "Missing organs"; GMW04, section 3.5]

#include <vector>

#include "blobtree/plant.h"

namespace barkridge {

/// A node that changes the subtree of an internode: in the order of the kinds.
struct Carving {
  enum class Kind {
    kAdded,       ///< summed with it
    kNegative,    ///< its field is subtracted
    kSubtracted,  ///< its solid is
  };
  InternodeId internode;
  Kind kind;
  NodeId node;
};

struct Carvings {
  std::vector<Carving> nodes;  ///< by falling internodes and, for each, rising kinds
  /// All internodes whose fields reach what is carved, and what is between them and where that is done.
  std::vector<std::uint32_t> touched;
};

/// Adds the nodes of all cut ends and scars to a tree and says where they belong. Cost: linear in internodes if there
/// are any, and in what is near each cut and scar.
Carvings add_carvings(const Plant& plant, BlobTree& tree);

}  // namespace barkridge
