#pragma once
// Operators at many points at once, for the instruction set that the machine has.

#include <span>

#include "blobtree/cone_kernels.h"
#include "blobtree/field_model.h"

namespace barkridge {

/// Replaces the first of several fields by what an operator makes of all of them: kSum, kUnion, kIntersection,
/// kDifference, kContact or kRicci. Columns have `size` numbers, a multiple of kBatchGranule.
void apply_operator(const FieldInstruction& instruction, const FieldModel& model, std::span<const FieldColumns> fields,
                    std::size_t size);

}  // namespace barkridge
