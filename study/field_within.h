#pragma once

#include "blobtree/field.h"

namespace barkridge {

/// A field cut off by a box: as it is inside, and 0 outside. So a small part of a large model's surface can be meshed
/// by itself; it is closed by the box's faces.
class FieldWithin final : public Field {
 public:
  FieldWithin(std::shared_ptr<const Field> whole, const Box& box);

  Box support() const override;
  void values(std::span<const Vec3> points, std::span<double> values) const override;
  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override;
  FieldBounds bounds(const Box& box) const override;
  std::shared_ptr<const Field> restricted(const Box& box) const override;
  std::unique_ptr<const SurfaceCells> cells() const override;
  std::size_t primitive_count() const override;

 private:
  std::shared_ptr<const Field> whole_;
  Box box_;
};

}  // namespace barkridge
