#pragma once
// Wood laid open: growth rings about the axis that was cut.

#include "bark/poplar_bark.h"

namespace barkridge {

struct Wood {
  Color color{0.58, 0.44, 0.27};
  double ring_width = 0.006;  ///< of the growth of a year, in scene units
};

/// At a point of the branch's straight space. Its outermost part is bark, in section.
PatternPoint wood_section(const Wood& wood, const BranchPoint& at, double footprint);

}  // namespace barkridge
