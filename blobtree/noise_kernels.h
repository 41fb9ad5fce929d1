#pragma once
// Displacements at many points at once, for the instruction set that the machine has.

#include <cstddef>

#include "blobtree/cone_kernels.h"
#include "blobtree/tree.h"

namespace barkridge {

/// A noise at a batch of points, and its gradient where `out` has room for it, in single precision about the points'
/// origin: as good as the points are, however far from the world's origin. `scale` is that of `ModelUnits`.
void sample_noise(const SolidNoise& noise, double scale, const PointBatch& points, const FieldColumns& out);

/// Displaces a field of `size` points, a multiple of kBatchGranule, by a noise there.
void displace(double amount, const FieldColumns& noise, const FieldColumns& field, std::size_t size);

}  // namespace barkridge
