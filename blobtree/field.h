#pragma once
// What everyone outside this room sees of a model: a scalar field, the solid it encloses, and bounds of both.
//
// Conventions of the whole program [GMW04, section 2.2]: the solid is { p : F(p) >= kIsoValue }, a point with F exactly
// at the iso-value is inside; the outward normal is -grad F / |grad F|; fields have no unit, and F = 0 outside a
// field's support.

#include <cstddef>
#include <limits>
#include <memory>
#include <span>

#include "base/geometry.h"
#include "blobtree/surface_cells.h"

namespace barkridge {

inline constexpr double kIsoValue = 0.5;

/// What is known about a field on a region.
struct FieldBounds {
  /// Encloses every value.
  Interval value{0, 0};
  /// At least the length of every gradient, and a Lipschitz constant of the field on the region if that is convex.
  double slope = 0;
  /// Encloses the second derivative along every line, where it is known; a crease that points up, like contact's,
  /// counts as +infinity and one that points down as -infinity, but for those that `kink` knows of.
  Interval second{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  /// At least what the slope along any line jumps by in all, where bends end. So between two points at a distance h the
  /// field is at most the larger of its values there minus second.lo h^2 / 8 plus kink h / 4.
  double kink = 0;
};

/// An immutable scalar field. Every member may be called from many threads at once.
class Field {
 public:
  virtual ~Field() = default;

  /// A box outside which the field is zero; empty for the zero field.
  virtual Box support() const = 0;

  /// F at every point. The spans have equal lengths. Equal points give equal bits, whatever the rest of the batch.
  virtual void values(std::span<const Vec3> points, std::span<double> values) const = 0;

  /// F and grad F at every point, F as by `values` to the bit. Where F has a crease, the gradient is one side's.
  virtual void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                                    std::span<Vec3> gradients) const = 0;

  /// Bounds over a non-empty box: conservative, and converging to the point's value as the box shrinks.
  virtual FieldBounds bounds(const Box& box) const = 0;

  /// The same field for use inside `box` only, without all that cannot matter there: values and gradients at points of
  /// the box agree to the bit with this field's, bounds of boxes inside it are at least as tight. Outside `box` nothing
  /// is promised.
  virtual std::shared_ptr<const Field> restricted(const Box& box) const = 0;

  /// Cells that hold the solid, or, if the field is restricted to a box, its part there. Cost: in proportion to the
  /// model. They keep what they need of the field.
  virtual std::unique_ptr<const SurfaceCells> cells() const;

  /// A measure of the work of one evaluation: the number of primitives. 0 for the zero field.
  virtual std::size_t primitive_count() const = 0;
};

}  // namespace barkridge
