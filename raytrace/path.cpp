#include "raytrace/path.h"

#include <cmath>
#include <glm/common.hpp>

namespace barkridge {

namespace {

// The ground fades into the horizon within some tens of scene sizes, as in haze, instead of ending at a line.
constexpr double kHazeRadius = 15;
// How much of the sky a point that sees the first surface can be expected to see itself, if it is on the solid.
constexpr double kSecondSkyShare = 0.5;
// What a scattered ray stands for widens by this much a length.
constexpr double kScatteredSpread = 0.25;

// Without its lobe, as seen by scattered rays: highlights of highlights are only specks.
Scattering dull(const Scattering& scattering) { return Scattering(Material{scattering.albedo(), 0, 1}); }

}  // namespace

PathTracer::PathTracer(const Tracer& tracer, const RenderScene& scene, const Footprint& footprint, int bounces)
    : tracer_(tracer),
      scene_(scene),
      footprint_(footprint),
      bounces_(bounces),
      sun_(scene.sun),
      sky_average_(sky_average(scene.sky)),
      bark_(scene.material),
      ground_(Material{scene.ground.color, 0, 1}) {
  const Box& box = scene.ground.surrounded.empty() ? tracer.scene_box() : scene.ground.surrounded;
  const Vec3 to_target = scene.camera.target - scene.camera.position;
  center_ = box.empty() ? scene.camera.target : box.center();
  haze_radius_ = kHazeRadius * (box.empty() ? glm::length(to_target) : box.diagonal());
}

PathTracer::Surface PathTracer::on_solid(const Ray& ray, const Hit& hit, const Footprint& footprint) const {
  Surface surface{hit.outside_point(), hit.normal, bark_, hit.t, hit.normal};
  if (scene_.shader) {
    const ShadedPoint shaded = scene_.shader->shade(hit.point, hit.normal, footprint.at(hit.t));
    surface.normal = shaded.normal;
    surface.scattering = Scattering(shaded.material);
  }
  // Rounding and bumps may turn a grazed normal away from the ray; bend it back.
  const double facing = -glm::dot(surface.normal, ray.direction);
  if (facing < 1e-4) surface.normal = glm::normalize(surface.normal - (1e-4 - facing) * ray.direction);
  if (!scene_.shader) surface.side = surface.normal;
  return surface;
}

// Along the ray; infinite where it does not meet the ground.
double PathTracer::ground_distance(const Ray& ray) const {
  if (scene_.ground.enabled && ray.direction.y != 0) {
    const double t = (scene_.ground.height - ray.origin.y) / ray.direction.y;
    if (t > 0) return t;
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<PathTracer::Surface> PathTracer::find_surface(const Ray& ray, const Footprint& footprint,
                                                            bool meets_solid) const {
  const double t_ground = ground_distance(ray);
  if (const std::optional<Hit> hit = meets_solid ? tracer_.first_hit(ray, 0, t_ground) : std::nullopt) {
    return on_solid(ray, *hit, footprint);
  }
  if (!std::isfinite(t_ground)) return std::nullopt;
  Vec3 point = ray.at(t_ground);
  point.y = scene_.ground.height;
  const double distance = std::hypot(point.x - center_.x, point.z - center_.z) / haze_radius_;
  const Vec3 up(0, ray.direction.y < 0 ? 1 : -1, 0);
  return Surface{point, up, ground_, t_ground, up, true, 1 - std::exp(-distance * distance)};
}

// Whether the sun is seen, past the solid and the ground.
bool PathTracer::lit_from(const Vec3& start, const Vec3& direction) const {
  const double above = start.y - scene_.ground.height;
  if (scene_.ground.enabled && above * direction.y < 0) return false;
  return !tracer_.occluded({start, direction});
}

Color PathTracer::from_sun(const Surface& surface, const Vec3& view, const glm::dvec2& u) const {
  const Vec3 light = sun_.direction(u);
  const Color scattered = surface.scattering.evaluate(surface.normal, view, light) * sun_.irradiance();
  if (scattered == Color(0) || !lit_from(surface.start, light)) return Color(0);
  return scattered;
}

Color PathTracer::from_surroundings(const Surface& surface, const Vec3& view, const PixelSampler& sampler,
                                    int sample) const {
  if (bounces_ == 0) return sky_average_ * surface.scattering.albedo();
  const double choice = surface.scattering.has_lobe() ? sampler.pair(sample, Dimension::kLobe).x : 0;
  const std::optional<ScatteredDirection> scattered =
      surface.scattering.sample(surface.normal, view, sampler.pair(sample, Dimension::kBounce), choice);
  if (!scattered || glm::dot(scattered->direction, surface.side) <= 0) return Color(0);
  const Color background = sky_radiance(scene_.sky, scattered->direction);
  const Footprint wide{footprint_.at(surface.t), kScatteredSpread};
  std::optional<Surface> second = find_surface({surface.start, scattered->direction}, wide, true);
  if (!second) return scattered->weight * background;
  second->scattering = dull(second->scattering);

  const Color sky = (second->is_ground ? 1 : kSecondSkyShare) * sky_average_ * second->scattering.albedo();
  const Color sun = from_sun(*second, -scattered->direction, sampler.pair(sample, Dimension::kBounceSun));
  return scattered->weight * glm::mix(sky + sun, background, second->haze);
}

std::optional<Radiance> PathTracer::plain_background() const {
  if (scene_.ground.enabled || scene_.sky.intensity > 0) return std::nullopt;
  return Radiance{};
}

Radiance PathTracer::along(const Ray& ray, const PixelSampler& sampler, int sample, bool meets_solid) const {
  const Radiance background{sky_radiance(scene_.sky, ray.direction), scene_.sky.intensity > 0 ? 1.0 : 0.0};
  const std::optional<Surface> surface = find_surface(ray, footprint_, meets_solid);
  if (!surface) return background;
  const Vec3 view = -ray.direction;
  const Color color = from_sun(*surface, view, sampler.pair(sample, Dimension::kSun)) +
                      from_surroundings(*surface, view, sampler, sample);
  return {glm::mix(color, background.color, surface->haze), glm::mix(1.0, background.alpha, surface->haze)};
}

}  // namespace barkridge
