#pragma once

#include <array>
#include <cstdint>

#include "polygonize/lattice.h"

namespace barkridge {

/// Which of a block's lattice points are inside: point (x, y, z) is bit x of row z * kBlockPoints + y.
using InsideRows = std::array<std::uint16_t, kBlockPoints * kBlockPoints>;

}  // namespace barkridge
