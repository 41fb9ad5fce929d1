#include "raytrace/path.h"

#include <algorithm>
#include <array>
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

// What a ray meets first: the solid where it is hit, or the ground.
std::optional<PathTracer::Surface> PathTracer::surface_along(const Ray& ray, double t_ground,
                                                             const std::optional<Hit>& hit,
                                                             const Footprint& footprint) const {
  if (hit) return on_solid(ray, *hit, footprint);
  if (!std::isfinite(t_ground)) return std::nullopt;
  Vec3 point = ray.at(t_ground);
  point.y = scene_.ground.height;
  const double distance = std::hypot(point.x - center_.x, point.z - center_.z) / haze_radius_;
  const Vec3 up(0, ray.direction.y < 0 ? 1 : -1, 0);
  return Surface{point, up, ground_, t_ground, up, true, 1 - std::exp(-distance * distance)};
}

PathTracer::Sunbeam PathTracer::sunbeam(const Surface& surface, const Vec3& view, const PixelSample& sample,
                                        Dimension dimension) const {
  const Vec3 light =
      sun_.is_point() ? sun_.direction({}) : sun_.direction(sample.sampler->pair(sample.number, dimension));
  const double above = surface.start.y - scene_.ground.height;
  if (scene_.ground.enabled && above * light.y < 0) return {light};
  return {light, surface.scattering.evaluate(surface.normal, view, light) * sun_.irradiance()};
}

Color PathTracer::from_sun(const Surface& surface, const Vec3& view, const PixelSample& sample,
                           Dimension dimension) const {
  const Sunbeam beam = sunbeam(surface, view, sample, dimension);
  if (beam.scattered == Color(0) || tracer_.occluded({surface.start, beam.direction})) return Color(0);
  return beam.scattered;
}

Color PathTracer::from_surroundings(const Surface& surface, const Vec3& view, const PixelSample& sample) const {
  if (bounces_ == 0) return sky_average_ * surface.scattering.albedo();
  const auto random = [&](Dimension dimension) { return sample.sampler->pair(sample.number, dimension); };
  const double choice = surface.scattering.has_lobe() ? random(Dimension::kLobe).x : 0;
  const std::optional<ScatteredDirection> scattered =
      surface.scattering.sample(surface.normal, view, random(Dimension::kBounce), choice);
  if (!scattered || glm::dot(scattered->direction, surface.side) <= 0) return Color(0);
  const Color background = sky_radiance(scene_.sky, scattered->direction);
  const Footprint wide{footprint_.at(surface.t), kScatteredSpread};
  const Ray ray{surface.start, scattered->direction};
  const double t_ground = ground_distance(ray);
  std::optional<Surface> second = surface_along(ray, t_ground, tracer_.first_hit(ray, 0, t_ground), wide);
  if (!second) return scattered->weight * background;
  second->scattering = dull(second->scattering);

  const Color sky = (second->is_ground ? 1 : kSecondSkyShare) * sky_average_ * second->scattering.albedo();
  const Color sun = from_sun(*second, -scattered->direction, sample, Dimension::kBounceSun);
  return scattered->weight * glm::mix(sky + sun, background, second->haze);
}

std::optional<Radiance> PathTracer::plain_background() const {
  if (scene_.ground.enabled || scene_.sky.intensity > 0) return std::nullopt;
  return Radiance{};
}

void PathTracer::along(std::span<const PixelSample> samples, std::span<Radiance> radiances) const {
  for (std::size_t start = 0; start < samples.size(); start += Tracer::kMostTogether) {
    const std::size_t count = std::min(Tracer::kMostTogether, samples.size() - start);
    trace_together(samples.subspan(start, count), radiances.subspan(start, count));
  }
}

// Scattered rays go everywhere and share nothing: they are traced one by one.
void PathTracer::trace_together(std::span<const PixelSample> samples, std::span<Radiance> radiances) const {
  constexpr std::size_t kMost = Tracer::kMostTogether;
  const std::size_t count = samples.size();
  std::array<RayPart, kMost> rays;
  std::array<double, kMost> grounds;
  std::array<std::optional<Hit>, kMost> hits;
  for (std::size_t i = 0; i < count; ++i) {
    grounds[i] = ground_distance(samples[i].ray);
    // Nothing is to be met where the range is empty.
    rays[i] = {samples[i].ray, samples[i].meets_solid ? Interval{0, grounds[i]} : Interval{}};
  }
  tracer_.first_hits(std::span(rays).first(count), std::span(hits).first(count));

  std::array<std::optional<Surface>, kMost> surfaces;
  std::array<Sunbeam, kMost> beams;
  std::array<RayPart, kMost> to_sun;
  std::array<std::size_t, kMost> lit;
  std::size_t lit_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = samples[i].ray;
    surfaces[i] = surface_along(ray, grounds[i], hits[i], footprint_);
    if (!surfaces[i]) continue;
    beams[i] = sunbeam(*surfaces[i], -ray.direction, samples[i], Dimension::kSun);
    if (beams[i].scattered == Color(0)) continue;
    lit[lit_count] = i;
    to_sun[lit_count++].ray = {surfaces[i]->start, beams[i].direction};
  }
  std::array<bool, kMost> in_shadow;
  tracer_.occluded(std::span(to_sun).first(lit_count), std::span(in_shadow).first(lit_count));
  for (std::size_t k = 0; k < lit_count; ++k) {
    if (in_shadow[k]) beams[lit[k]].scattered = Color(0);
  }

  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = samples[i].ray;
    const Radiance background{sky_radiance(scene_.sky, ray.direction), scene_.sky.intensity > 0 ? 1.0 : 0.0};
    radiances[i] = background;
    if (!surfaces[i]) continue;
    const Surface& surface = *surfaces[i];
    const Color color = beams[i].scattered + from_surroundings(surface, -ray.direction, samples[i]);
    radiances[i] = {glm::mix(color, background.color, surface.haze), glm::mix(1.0, background.alpha, surface.haze)};
  }
}

}  // namespace barkridge
