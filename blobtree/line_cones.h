#pragma once
// What rays meet: which primitives matter to them, where, and how strong, steep and bent the fields of cones are along
// them.

#include <array>
#include <span>
#include <vector>

#include "blobtree/field_model.h"
#include "blobtree/ray_bundle.h"

namespace barkridge {

struct LineMeeting {
  /// The rays on whose ranges the field can reach the iso-value. All that follows is about these.
  RayLanes rays = 0;
  /// The part of each one's range on which the sum of the primitives that can add to the model's field can be positive.
  RayRanges reach;
  /// The primitives that matter on any of the ranges, in rising order.
  std::vector<std::uint32_t> primitives;
  /// Of those that are cones, bounds through all warps above on all the ranges, and whether they may be evaluated as
  /// steady there.
  std::vector<ConeBounds> cones;
};

/// What some rays of a bundle meet of some primitives, which are given in rising order, on parts of the rays that are
/// near each other: none is farther from another than a few times the size of what is met.
void meet(const FieldModel& model, std::span<const std::uint32_t> primitives, const RayBundle& bundle, RayLanes rays,
          const RayRanges& ranges, LineMeeting& meeting);

}  // namespace barkridge
