#pragma once
// Limbs of a skeleton that pass through each other.

#include <cstddef>

#include "lsystem/skeleton.h"

namespace barkridge {

/// The number of pairs of internodes that have no end in common and whose axes come nearer to each other than `reach`
/// times the sum of their radii, each internode's at its thicker end. With a reach of 1 these are limbs that cross in
/// space, as an L-system may well have it: no surface that gives every limb its own skin can keep them apart. O(n log
/// n) where limbs are spread over the plant's longest extent.
std::size_t crossing_limbs(const Skeleton& skeleton, double reach = 1);

}  // namespace barkridge
