#pragma once
// Confined blending: which internodes are joined as a whole, and at which this ends.

#include <cstdint>
#include <span>
#include <vector>

#include "blobtree/plant.h"

namespace barkridge {

/// By internode, whether blending ends at it, so that it stands in two groups: in that of what it carries and in that
/// of what carries it. What meets at an internode's base and what meets at its tip are one group where fields of both
/// may be other than zero together within the internode's own; apart, they leave its surface smooth. [docs/field.md,
/// "Confined blending"] Those in `undivided` end nothing, nor do internodes without children. Cost: N log N, times how
/// often groups grow into each other, which is a few times.
std::vector<bool> ends_of_blending(const Plant& plant, std::span<const std::uint32_t> undivided);

}  // namespace barkridge
