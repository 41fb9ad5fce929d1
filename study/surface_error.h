#pragma once
// The error of a triangulated surface against the surface that it stands for, on a sample of it.

#include <functional>
#include <span>
#include <vector>

#include "lsystem/skeleton.h"
#include "study/surface_distance.h"

namespace barkridge {

/// Boxes around points of a plant's surface, half of them at forks where there are any, the others anywhere, drawn with
/// weights that are the internodes' lengths. Each is as wide as `side` or three times its internode's thickness,
/// whichever is less. A function of its arguments.
std::vector<Box> error_windows(const Skeleton& skeleton, double side, int count);

/// Makes a much finer triangulation of the surface for use inside of a box; outside of it anything may follow.
using FineSurface = std::function<Mesh(const Box&)>;

/// For each mesh the two-sided distance to the fine surface within the windows: from the points of each that lie in a
/// window to the other. `reach` is how far around a window nearest points are sought for. The fine surface is made once
/// for every window.
std::vector<DistanceSummary> surface_errors(std::span<const Mesh> meshes, const std::vector<Box>& windows, double reach,
                                            const FineSurface& fine);

}  // namespace barkridge
