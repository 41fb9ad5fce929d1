#pragma once
// What a line meets: which primitives matter to it, where, and how strong, steep and bent the fields of cones are along
// it.

#include <span>
#include <vector>

#include "blobtree/field_model.h"

namespace barkridge {

struct LineMeeting {
  /// The part of the range on which the sum of the primitives that can add to the model's field can be positive; empty
  /// if there is none.
  Interval reach;
  /// At least what they, with the gain of all displacements above them, add up to anywhere on it; infinite where there
  /// are others than cones.
  double highest_sum = 0;
  /// Those that matter on the range, in rising order.
  std::vector<std::uint32_t> primitives;
  /// Bounds of the cones among them, in their order and through all warps above, and whether they may be evaluated as
  /// steady.
  std::vector<ConeBounds> cones;
};

/// What a piece of a ray meets of some primitives, which are given in rising order.
void meet(const FieldModel& model, std::span<const std::uint32_t> primitives, const Ray& ray, const Interval& range,
          LineMeeting& meeting);

}  // namespace barkridge
