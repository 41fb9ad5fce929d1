#pragma once
// What else a picture can hold of a surface than its colour.

#include <span>
#include <string>
#include <vector>

#include "base/geometry.h"

namespace barkridge {

/// Tells numbers of a solid's surface point by point. Immutable; asked from many threads at once.
class SurfaceLayers {
 public:
  virtual ~SurfaceLayers() = default;

  /// Names of the numbers, as channels of an image have them.
  virtual std::vector<std::string> names() const = 0;
  /// As many numbers, at a point of the surface.
  virtual void values(const Vec3& point, std::span<float> values) const = 0;
};

}  // namespace barkridge
