#pragma once
// The deformation of a field where it touches another. [docs/field.md, "Precise contact"; GMW04, section 2.3; after
// Cani 1993]

#include "base/geometry.h"
#include "blobtree/tree.h"

namespace barkridge {

/// h(x): what a child whose field is x below the iso-value adds to the one it touches; 0 outside [0, width]. h(0) = 0,
/// h'(0) = 1, its maximum is `swelling` at width / 2, and it is C1.
double contact_expansion(const ContactShape& shape, double x);
double contact_expansion_slope(const ContactShape& shape, double x);

/// Whether contact is known never to make more of its children than their sum: h(x) <= T - x. So it is where |h'| <= 1,
/// up to a swelling of width / 3, which only `allow_large_swelling` lets it exceed.
bool is_below_sum(const ContactShape& shape);

/// The largest |h''|.
double most_bent_expansion(const ContactShape& shape);

/// The derivative of what a child with field `f` does to another: -(f - T) where it presses, h(T - f) where it only
/// nears.
inline double contact_effect_slope(const ContactShape& shape, double f) {
  return f >= kIsoValue ? -1.0 : -contact_expansion_slope(shape, kIsoValue - f);
}

/// The smallest and largest expansion and the steepest effect of a child whose field lies in `f`.
struct ContactRange {
  double lowest_expansion = 0;
  double highest_expansion = 0;
  double steepest_effect = 0;
};
ContactRange contact_range(const ContactShape& shape, const Interval& f);

}  // namespace barkridge
