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

/// Adds the nodes of all cut ends and scars to a tree and says where they belong, by falling internodes and, for each,
/// rising kinds. Cost: linear in internodes if there are any, and in what is near each cut and scar.
std::vector<Carving> add_carvings(const Plant& plant, BlobTree& tree);

}  // namespace barkridge
