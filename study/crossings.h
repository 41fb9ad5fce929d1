#pragma once

#include <cstddef>

#include "mesh/mesh.h"

namespace barkridge {

/// The number of pairs of triangles that cross though they have no vertex in common: where a mesh meets itself. Pairs
/// in one plane, and pairs that only touch, may be counted or not, as rounding has it. Parallel; the same for any
/// number of threads. Throws `std::bad_alloc`.
std::size_t crossing_pairs(const Mesh& mesh);

}  // namespace barkridge
