#include "raytrace/tracer.h"

#include <algorithm>
#include <array>

#include "raytrace/traced_scene.h"

namespace barkridge {

namespace {

// Rays from where they enter the scene's box: t counts from there and is precise for rays from afar.
struct Entries {
  RayBundle bundle;
  std::array<double, RayBundle::kWidth> starts;
  std::array<std::size_t, RayBundle::kWidth> numbers;  // of those that enter

  Entries(const TracedScene& scene, std::span<const RayPart> rays) {
    if (scene.box().empty()) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Interval range = clip(rays[i].ray, scene.box(), rays[i].range);
      if (range.empty()) continue;
      starts[bundle.count] = range.lo;
      numbers[bundle.count] = i;
      bundle.add({rays[i].ray.at(range.lo), rays[i].ray.direction}, {0, range.hi - range.lo});
    }
  }
};

}  // namespace

Tracer::Tracer(const Field& field, const Progress& progress) {
  report(progress, 0);
  scene_ = traced_scene(field);
}
Tracer::Tracer(const Mesh& mesh, const Progress& progress) {
  report(progress, 0);
  scene_ = traced_scene(mesh);
}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

std::size_t Tracer::part_count() const { return scene_->part_count(); }
Box Tracer::part(std::size_t index) const { return scene_->part(index); }
const Box& Tracer::scene_box() const { return scene_->box(); }
double Tracer::tolerance() const { return scene_->tolerance(); }

std::optional<Hit> Tracer::first_hit(const Ray& ray, double t_min, double t_max) const {
  const RayPart part{ray, {t_min, t_max}};
  std::optional<Hit> hit;
  first_hits({&part, 1}, {&hit, 1});
  return hit;
}

bool Tracer::occluded(const Ray& ray, double t_min, double t_max) const {
  const RayPart part{ray, {t_min, t_max}};
  bool is_occluded = false;
  occluded({&part, 1}, {&is_occluded, 1});
  return is_occluded;
}

void Tracer::first_hits(std::span<const RayPart> rays, std::span<std::optional<Hit>> hits) const {
  std::fill(hits.begin(), hits.end(), std::nullopt);
  const Entries entries(*scene_, rays);
  if (entries.bundle.count == 0) return;
  std::array<std::optional<Hit>, RayBundle::kWidth> found;
  scene_->first_hits(entries.bundle, found);
  for (std::size_t i = 0; i < entries.bundle.count; ++i) {
    if (!found[i]) continue;
    found[i]->t += entries.starts[i];
    hits[entries.numbers[i]] = found[i];
  }
}

void Tracer::occluded(std::span<const RayPart> rays, std::span<bool> are_occluded) const {
  std::fill(are_occluded.begin(), are_occluded.end(), false);
  const Entries entries(*scene_, rays);
  if (entries.bundle.count == 0) return;
  for_each_lane(scene_->occluded(entries.bundle),
                [&](std::size_t lane) { are_occluded[entries.numbers[lane]] = true; });
}

}  // namespace barkridge
