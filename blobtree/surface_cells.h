#pragma once
// The one spatial structure of renderer and polygonizer: where the surface of a solid may be.

#include <array>
#include <cstddef>

#include "base/geometry.h"
#include "blobtree/ray_bundle.h"

namespace barkridge {

/// Where a ray meets a solid, and the field's gradient there.
struct SurfacePoint {
  double t = 0;
  Vec3 gradient{0};
};

/// Cells that together hold a field's solid, each so small that few primitives matter in it; they may overlap.
/// Immutable: every member may be called from many threads at once.
class SurfaceCells {
 public:
  virtual ~SurfaceCells() = default;

  virtual std::size_t size() const = 0;

  /// A box that holds the cell, but for what lies outside the field's support.
  virtual Box box(std::size_t cell) const = 0;

  /// Where some rays of a bundle first are in the cell and inside the solid, with t in their ranges; t is exact to
  /// `tolerance`, or to some more where the field has a crease or the ray grazes. Nothing is missed that is thicker
  /// than that along the ray and exceeds the iso-value by more than 1e-5. Returns the rays that have such a point, of
  /// those with one before their `limits`; others need not be found.
  virtual RayLanes first_inside(std::size_t cell, const RayBundle& bundle, RayLanes rays,
                                const RayRanges::Column& limits, double tolerance,
                                std::array<SurfacePoint, RayBundle::kWidth>& found) const = 0;

  /// The rays that have any such point. Cheaper.
  virtual RayLanes any_inside(std::size_t cell, const RayBundle& bundle, RayLanes rays, double tolerance) const = 0;
};

}  // namespace barkridge
