#pragma once
// The one spatial structure of renderer and polygonizer: where the surface of a solid may be.

#include <cstddef>
#include <optional>

#include "base/geometry.h"

namespace barkridge {

/// A field at a point.
struct FieldSample {
  double value = 0;
  Vec3 gradient{0};
};

/// Cells that together hold a field's solid, each so small that few primitives matter in it; they may overlap.
/// Immutable: every member may be called from many threads at once.
class SurfaceCells {
 public:
  virtual ~SurfaceCells() = default;

  virtual std::size_t size() const = 0;

  /// Holds the cell.
  virtual Box box(std::size_t cell) const = 0;

  /// The smallest t in `range` at which the ray is in the cell and inside the solid, or none; exact to `precision`.
  /// Nothing is missed that is thicker than `tolerance` along the ray and exceeds the iso-value by more than 1e-5.
  virtual std::optional<double> first_inside(std::size_t cell, const Ray& ray, const Interval& range, double tolerance,
                                             double precision) const = 0;

  /// Whether there is any such t. Cheaper.
  virtual bool any_inside(std::size_t cell, const Ray& ray, const Interval& range, double tolerance) const = 0;

  /// The field at a point of the cell.
  virtual FieldSample sample(std::size_t cell, const Vec3& point) const = 0;
};

}  // namespace barkridge
