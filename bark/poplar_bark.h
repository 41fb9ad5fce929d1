#pragma once
// The bark of a poplar: smooth and pale with lenticels on what is thin, furrowed on what is thick.

#include "bark/branch_coordinates.h"
#include "base/graded.h"
#include "raytrace/surface_shader.h"

namespace barkridge {

struct PoplarBark {
  double scale = 0.05;            ///< width of a furrowed ridge, in scene units
  double furrowed_radius = 0.12;  ///< of branches that are half smooth, half furrowed
  Color smooth_color{0.36, 0.37, 0.30};
  Color furrowed_color{0.26, 0.235, 0.20};  ///< of the ridges; the furrows between are darker
};

/// A point of a pattern.
struct PatternPoint {
  Color color{0};
  /// Above the mean surface, in scene units, with its gradient in the branch's straight space.
  Graded height;
};

/// At a point of the branch's straight space. Details that are finer than `footprint` are their mean.
PatternPoint poplar_bark(const PoplarBark& bark, const BranchPoint& at, double footprint);

}  // namespace barkridge
