#pragma once
// Cones at many points at once: the innermost loops of everything, for the instruction set that the machine has.
//
// Single precision. A point's bits do not depend on its batch, nor on cones that are zero there; between instruction
// sets they may differ by rounding, since only some fuse multiplication and addition.

#include <array>
#include <cstddef>
#include <span>

#include "blobtree/cone_record.h"

namespace barkridge {

/// Batches are padded to a multiple of so many points. What stands in the rest does not matter.
inline constexpr std::size_t kBatchGranule = 16;

/// Points relative to an origin, in units of the model.
struct PointBatch {
  Vec3 origin{0};  ///< in scene units
  std::array<float*, 3> at{};
  std::size_t size = 0;  ///< a multiple of kBatchGranule
};

/// A field at a batch of points: its values, and its gradients' coordinates per unit of the model where they are
/// wanted, else null.
struct FieldColumns {
  float* f = nullptr;
  std::array<float*, 3> gradient{};

  bool has_gradient() const { return gradient[0] != nullptr; }
};

/// What a cone's formula needs of it, wherever it stands.
struct ConeShape {
  float base_radius, tip_radius, taper, length;
  float rise_start, rise_scale, fall_start, fall_scale;
  ConeKind kind;
  bool free_base, free_tip;
};

/// A cone relative to a batch's origin.
struct LocalCone : ConeShape {
  std::array<float, 3> base, axis;
};
LocalCone local_cone(const ConeRecord& record, ConeKind kind, const Vec3& origin, double scale);

/// The sum of the cones' fields, in their order, written to `out`.
void sum_cones(std::span<const LocalCone> cones, const PointBatch& points, const FieldColumns& out);

/// A cone as a line sees it: with d = t - nearest, the height over its base along the axis is y0 + y1 d and the square
/// of the distance from the axis rho2 + slope d + across2 d^2.
struct LineCone : ConeShape {
  float nearest, y0, y1, rho2, slope, across2;
};
/// `origin` is the line's point at t = 0; t is in units of the model and at most `reach` in size.
LineCone line_cone(const ConeRecord& record, ConeKind kind, const Vec3& origin, const Vec3& direction, double scale,
                   double reach);

/// The sum of the cones' fields at kBatchGranule points of the line.
void sum_cones_along(std::span<const LineCone> cones, const float* t, float* f);

}  // namespace barkridge
