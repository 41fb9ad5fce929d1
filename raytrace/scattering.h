#pragma once
// How a surface scatters light: Lambert plus a rough specular lobe.

#include <optional>

#include <glm/vec2.hpp>

#include "raytrace/render.h"

namespace barkridge {

/// A sampled direction of incoming light.
struct ScatteredDirection {
  Vec3 direction;
  /// Scattering function times cosine over the probability density of the direction.
  Color weight;
};

/// Lambert with `material.color`, of which the specular reflectance at normal incidence is taken off, plus an isotropic
/// GGX lobe of width roughness squared, with Smith's correlated shadowing and Schlick's Fresnel term. [Walter et al.
/// 2007; Heitz 2014] All directions are unit vectors and point away from the surface.
class Scattering {
 public:
  explicit Scattering(const Material& material);

  const Color& albedo() const { return material_.color; }
  /// Whether there is a lobe; if not, `sample` does not look at its choice.
  bool has_lobe() const { return material_.specular > 0; }

  /// Scattering function times the cosine of `light`; 0 when `view` or `light` are below the surface.
  Color evaluate(const Vec3& normal, const Vec3& view, const Vec3& light) const;

  /// A direction of incoming light: by the lobe when `choice` is small, by the cosine else, weighted for both. None
  /// when it would come from below.
  std::optional<ScatteredDirection> sample(const Vec3& normal, const Vec3& view, const glm::dvec2& u,
                                           double choice) const;

 private:
  Material material_;
  Color diffuse_;  // Lambert's constant
  double alpha_;
};

}  // namespace barkridge
