#pragma once
// What everyone outside this room sees of a model: a scalar field, the solid it encloses, and bounds of both.
//
// Conventions of the whole program [GMW04, section 2.2]: the solid is { p : F(p) >= kIsoValue }, a point with F exactly
// at the iso-value is inside; the outward normal is -grad F / |grad F|; fields have no unit, and F = 0 outside a
// field's support.

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/geometry.h"

namespace barkridge {

inline constexpr double kIsoValue = 0.5;

/// What is known about a field on a region.
struct FieldBounds {
  /// Encloses every value.
  Interval value{0, 0};
  /// At least the length of every gradient, and a Lipschitz constant of the field on the region if that is convex.
  double slope = 0;
  /// Encloses the second derivative along every line, where it is known; a crease that points up, like contact's,
  /// counts as +infinity and one that points down as -infinity. So between two points at a distance h the field is at
  /// most the larger of its values there minus second.lo h^2 / 8.
  Interval second{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
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

  /// Boxes that together hold the solid, each so small that few primitives matter in it; they may overlap. Cost: in
  /// proportion to the model.
  virtual std::vector<Box> cover() const;

  /// The smallest t in `range` at which the ray is inside the solid, or none; exact to `tolerance`. Nothing is missed
  /// that is thicker than that along the ray and exceeds the iso-value by more than 1e-5. The range must lie in the box
  /// that the field is restricted to, to rounding.
  virtual std::optional<double> first_inside(const Ray& ray, const Interval& range, double tolerance) const;

  /// Whether there is any such t. Cheaper.
  virtual bool any_inside(const Ray& ray, const Interval& range, double tolerance) const;

  /// A measure of the work of one evaluation: the number of primitives. 0 for the zero field.
  virtual std::size_t primitive_count() const = 0;
};

}  // namespace barkridge
