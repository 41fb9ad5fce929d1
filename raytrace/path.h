#pragma once
// The light that comes back along a ray.

#include <optional>

#include "raytrace/camera.h"
#include "raytrace/light.h"
#include "raytrace/render.h"
#include "raytrace/sampler.h"
#include "raytrace/scattering.h"
#include "raytrace/tracer.h"

namespace barkridge {

/// Premultiplied colour and coverage.
struct Radiance {
  Color color{0};
  double alpha = 0;
};

/// Estimates radiance with one path a sample: sunlight with shadows at the first surface, one scattered ray for the sky
/// and for the surfaces around, which are themselves lit by the sun with shadows and by the sky's average.
class PathTracer {
 public:
  /// `footprint` is that of the rays that `along` is asked about.
  PathTracer(const Tracer& tracer, const RenderScene& scene, const Footprint& footprint, int bounces);

  /// One sample of what arrives at the ray's origin from its direction. `meets_solid` is false only where it is known
  /// that the ray itself meets nothing of the solid.
  Radiance along(const Ray& ray, const PixelSampler& sampler, int sample, bool meets_solid) const;

  /// Where a ray first meets the solid, if nothing stands before it.
  std::optional<Hit> solid_along(const Ray& ray) const { return tracer_.first_hit(ray, 0, ground_distance(ray)); }

  /// What arrives along all rays that meet nothing of the solid, if that is the same for all.
  std::optional<Radiance> plain_background() const;

 private:
  struct Surface {
    Vec3 start;   // where secondary rays leave
    Vec3 normal;  // on the viewer's side
    Scattering scattering;
    double t;   // along the ray
    Vec3 side;  // the normal without bumps: no light comes from beyond
    bool is_ground = false;
    double haze = 0;  // share of the background in front of it
  };

  double ground_distance(const Ray& ray) const;
  std::optional<Surface> find_surface(const Ray& ray, const Footprint& footprint, bool meets_solid) const;
  Surface on_solid(const Ray& ray, const Hit& hit, const Footprint& footprint) const;
  Color from_sun(const Surface& surface, const Vec3& view, const glm::dvec2& u) const;
  Color from_surroundings(const Surface& surface, const Vec3& view, const PixelSampler& sampler, int sample) const;
  bool lit_from(const Vec3& start, const Vec3& direction) const;

  const Tracer& tracer_;
  const RenderScene& scene_;
  Footprint footprint_;
  int bounces_;
  SunDisc sun_;
  Color sky_average_;
  Scattering bark_;
  Scattering ground_;
  Vec3 center_;
  double haze_radius_;
};

}  // namespace barkridge
