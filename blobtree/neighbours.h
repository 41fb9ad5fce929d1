#pragma once
// What of a plant is near a place, and its field there.

#include <cstdint>
#include <optional>
#include <vector>

#include "blobtree/box_hierarchy.h"
#include "blobtree/plant.h"

namespace barkridge {

class Neighbours {
 public:
  /// The plant must outlive it. Cost: linear.
  explicit Neighbours(const Plant& plant);

  /// Internodes whose fields may reach into a box, in rising order.
  std::vector<std::uint32_t> near(const Box& box) const;

  /// The field of some internodes, in rising order, as a node: that of the whole tree where only they matter and where
  /// they hang together. Other cut ends among them are cut by their own planes alone, scars are left out. Nothing if
  /// there is nothing.
  std::optional<NodeId> add_field_of(const std::vector<std::uint32_t>& some, BlobTree& tree) const;

 private:
  std::optional<NodeId> join(std::vector<NodeId>& branches, BlobTree& tree) const;
  std::optional<NodeId> add_subtree(std::size_t i, std::optional<NodeId> beyond, BlobTree& tree) const;

  const Plant& plant_;
  BoxHierarchy supports_;
};

/// A thick disc whose flat side is a cut. It holds all that the internode's field reaches beyond.
Disc cutter(const Plant& plant, const CutEnd& end);

}  // namespace barkridge
