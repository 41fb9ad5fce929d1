#pragma once
// The light that comes back along a ray.

#include <optional>
#include <span>

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

/// A sample of a pixel: a ray through it, and where its random numbers come from.
struct PixelSample {
  Ray ray;
  const PixelSampler* sampler = nullptr;
  int number = 0;
  bool meets_solid = true;  ///< false only where it is known that the ray itself meets nothing of the solid
};

/// Estimates radiance with one path a sample: sunlight with shadows at the first surface, one scattered ray for the sky
/// and for the surfaces around, which are themselves lit by the sun with shadows and by the sky's average.
class PathTracer {
 public:
  /// `footprint` is that of the rays that `along` is asked about.
  PathTracer(const Tracer& tracer, const RenderScene& scene, const Footprint& footprint, int bounces);

  /// What arrives at the rays' origins from their directions. Samples of neighbouring pixels share their work: as
  /// many as a tracer can that follow each other are traced together, and so are the rays towards the sun from what
  /// they meet.
  void along(std::span<const PixelSample> samples, std::span<Radiance> radiances) const;

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

  // The way to a place on the sun, and what its light brings on from a surface to a viewer if nothing is in the way.
  struct Sunbeam {
    Vec3 direction;
    Color scattered{0};
  };

  double ground_distance(const Ray& ray) const;
  std::optional<Surface> surface_along(const Ray& ray, double t_ground, const std::optional<Hit>& hit,
                                       const Footprint& footprint) const;
  Surface on_solid(const Ray& ray, const Hit& hit, const Footprint& footprint) const;
  Sunbeam sunbeam(const Surface& surface, const Vec3& view, const PixelSample& sample, Dimension dimension) const;
  Color from_sun(const Surface& surface, const Vec3& view, const PixelSample& sample, Dimension dimension) const;
  Color from_surroundings(const Surface& surface, const Vec3& view, const PixelSample& sample) const;
  void trace_together(std::span<const PixelSample> samples, std::span<Radiance> radiances) const;

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
