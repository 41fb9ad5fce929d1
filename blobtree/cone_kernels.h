#pragma once
// Cones at many points at once: the innermost loops of everything, for the instruction set that the machine has.
//
// Every set computes the same bits: the same operations on the same doubles in the same order, none of them fused.

#include <cstddef>

#include "blobtree/field_program.h"

namespace barkridge {

/// Kernels run over whole vectors, so every column has room for a multiple of this many numbers, whatever the number of
/// points. What stands in the rest does not matter.
inline constexpr std::size_t kBatchGranule = 8;

/// Points in columns.
struct PointBatch {
  const double* x;
  const double* y;
  const double* z;
  std::size_t size;
};

/// A field at a batch of points: its values, and its gradients' coordinates where they are wanted.
struct FieldColumns {
  double* f;
  double* gx;  ///< null when no gradients are wanted
  double* gy;
  double* gz;
};

void evaluate_cone(const FieldProgramData::ConeData& cone, const PointBatch& points, const FieldColumns& out);
void evaluate_faded_cone(const FieldProgramData::FadedConeData& cone, const PointBatch& points,
                         const FieldColumns& out);

}  // namespace barkridge
