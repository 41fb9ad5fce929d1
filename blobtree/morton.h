#pragma once

#include <algorithm>
#include <cstdint>

#include "base/geometry.h"

namespace barkridge {

/// Interleaves the bits of a place in a box, so that places next to each other in order are near each other in space.
/// [Morton 1966]
inline std::uint64_t morton_code(const Vec3& p, const Box& box) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = box.hi[axis] - box.lo[axis];
    const double t = extent > 0 ? (p[axis] - box.lo[axis]) / extent : 0;
    auto place = static_cast<std::uint64_t>(std::clamp(t, 0.0, 1.0) * 0x1FFFFF);
    // Two zeros in front of every bit.
    place = (place | place << 32) & 0x1f00000000ffffull;
    place = (place | place << 16) & 0x1f0000ff0000ffull;
    place = (place | place << 8) & 0x100f00f00f00f00full;
    place = (place | place << 4) & 0x10c30c30c30c30c3ull;
    place = (place | place << 2) & 0x1249249249249249ull;
    code |= place << axis;
  }
  return code;
}

}  // namespace barkridge
