#pragma once
// How the parts of the subdivision path grow with their work, as the report measured his [Pieterse, section 5.3].

#include <vector>

#include "study/plot.h"

namespace barkridge {

/// Seconds to make one joint of 2 to 200 branches, spread evenly over a sphere, by convex hulls; and of as many in a
/// plane by templates [Pieterse, figure 5.7]. Medians of `turns`.
std::vector<PlotSeries> joint_times(int turns);

/// Seconds of one step of Loop subdivision against the triangles that it starts from [Pieterse, figure 5.8]. Medians of
/// `turns`.
PlotSeries loop_times(int turns);

}  // namespace barkridge
