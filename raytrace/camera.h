#pragma once
// From places in the picture to rays.

#include <optional>

#include <glm/vec2.hpp>

#include "raytrace/render.h"

namespace barkridge {

/// How wide a pixel is on a surface across a ray, at a distance.
struct Footprint {
  double width = 0;   ///< where the ray starts
  double spread = 0;  ///< what it grows by a length

  double at(double t) const { return width + spread * t; }
};

/// A checked camera in front of a picture of some size in pixels.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);

  /// The ray through a place in the picture, in pixels to the right of and below its top left corner. Perspective
  /// rays start at the camera's position, orthographic ones on the plane through it across the view.
  Ray through(double x, double y) const;

  /// Of the rays through pixels.
  Footprint footprint() const;

  /// Where in the picture a point is seen; nothing for points that are not before the camera.
  std::optional<glm::dvec2> place_of(const Vec3& point) const;

 private:
  bool perspective_;
  Vec3 position_;
  Vec3 view_;
  Vec3 right_, down_;  // the length of half the picture's height
  double width_, height_;
};

}  // namespace barkridge
