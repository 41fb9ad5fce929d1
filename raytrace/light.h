#pragma once
// The sun and the sky as light sources.

#include <glm/vec2.hpp>

#include "raytrace/render.h"

namespace barkridge {

/// What is seen of the sky in a unit direction. From horizon to zenith the colour changes with the cube of 1 - height,
/// as air whitens towards the horizon; below the horizon it is the horizon's.
Color sky_radiance(const Sky& sky, const Vec3& direction);

/// The radiance of a white Lambert surface that faces up under the whole sky.
Color sky_average(const Sky& sky);

/// The sun as a disc of directions.
class SunDisc {
 public:
  explicit SunDisc(const Sun& sun);

  /// Whether all directions are the same.
  bool is_point() const { return one_minus_cosine_ == 0; }
  /// A unit direction towards a place on the disc, uniform over it for uniform `u`.
  Vec3 direction(const glm::dvec2& u) const;
  /// Irradiance on a surface that faces the sun.
  const Color& irradiance() const { return irradiance_; }

 private:
  Vec3 center_, across_, along_;
  double one_minus_cosine_;
  Color irradiance_;
};

}  // namespace barkridge
