#pragma once
// Boxes over boxes: which primitives of a model can matter in a region.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.h"

namespace barkridge {

/// A hierarchy over boxes in the order of a space-filling curve: every group of eight neighbours has a box around them,
/// every eight groups one around those, and so on, without links. 35 bytes a box.
class BoxHierarchy {
 public:
  BoxHierarchy() = default;
  explicit BoxHierarchy(std::span<const Box> boxes);

  /// Appends the numbers of the boxes that overlap `region`, rounded outward to floats, in rising order. Stops and
  /// returns false as soon as there are more than `most`. Cost: in proportion to what is found, times the logarithm of
  /// all.
  bool find(const Box& region, std::size_t most, std::vector<std::uint32_t>& found) const;

  /// The numbers of up to eight neighbours along the curve; there are as many groups of them as `group_count` says.
  std::span<const std::uint32_t> group(std::size_t number) const;
  std::size_t group_count() const { return levels_.empty() ? 0 : levels_[0].size(); }

  /// A box, rounded outward.
  Box box(std::size_t number) const;
  std::size_t size() const { return numbers_.size(); }
  std::size_t memory() const;

 private:
  static constexpr std::size_t kWidth = 8;
  // Eight boxes side by side, so that one comparison looks at all of them. Missing ones are empty.
  struct alignas(32) Group {
    std::array<std::array<float, kWidth>, 3> lo, hi;
  };
  /// Groups of eight of what `bounds_of(number)` gives.
  template <typename BoundsOf>
  static std::vector<Group> level_over(std::size_t count, const BoundsOf& bounds_of);
  static unsigned overlapping(const Group& group, const std::array<float, 3>& lo, const std::array<float, 3>& hi);

  std::vector<std::uint32_t> numbers_;      // of the boxes along the curve
  std::vector<std::uint32_t> places_;       // of the boxes on it
  std::vector<std::vector<Group>> levels_;  // the boxes themselves first, one group last
};

}  // namespace barkridge
