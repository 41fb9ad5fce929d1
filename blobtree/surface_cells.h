#pragma once
// The one spatial structure of renderer and polygonizer: where the surface of a solid may be.

#include <cstddef>
#include <optional>

#include "base/geometry.h"

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

  /// Where the ray first is in the cell and inside the solid, with t in `range`, or nothing; t is exact to `tolerance`,
  /// or to some more where the field has a crease or the ray grazes. Nothing is missed that is thicker than that along
  /// the ray and exceeds the iso-value by more than 1e-5. What is not before `limit` need not be found.
  virtual std::optional<SurfacePoint> first_inside(std::size_t cell, const Ray& ray, const Interval& range,
                                                   double limit, double tolerance) const = 0;

  /// Whether there is any such point. Cheaper.
  virtual bool any_inside(std::size_t cell, const Ray& ray, const Interval& range, double tolerance) const = 0;
};

}  // namespace barkridge
