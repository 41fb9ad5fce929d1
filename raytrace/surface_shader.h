#pragma once
// How a surface scatters light, and who says so where it is not the same everywhere.

#include <glm/vec3.hpp>

#include "base/geometry.h"

namespace barkridge {

/// Linear Rec. 709 colour, no unit.
using Color = glm::dvec3;

/// Lambert plus a rough specular lobe (GGX).
struct Material {
  Color color{0.38, 0.31, 0.235};
  double specular = 0.04;  ///< reflectance at normal incidence, 0 for none
  double roughness = 0.6;  ///< in (0, 1]
};

/// A point of a surface as light finds it.
struct ShadedPoint {
  Material material;
  Vec3 normal{0};  ///< unit, of the surface with its bumps
};

/// Tells the material of a solid's surface point by point. Immutable; asked from many threads at once. Answers depend
/// on the arguments only.
class SurfaceShader {
 public:
  virtual ~SurfaceShader() = default;

  /// At a point of the surface with its outward unit normal. `footprint` is the width of what the answer stands for, in
  /// scene units: details much smaller than that should be their mean.
  virtual ShadedPoint shade(const Vec3& point, const Vec3& normal, double footprint) const = 0;
};

}  // namespace barkridge
