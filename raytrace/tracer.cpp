#include "raytrace/tracer.h"

#include "raytrace/traced_scene.h"

namespace barkridge {

namespace {

// The ray from where it enters the scene's box: t counts from there and is precise for rays from afar.
struct Entry {
  Ray ray;
  Interval range;

  Entry(const TracedScene& scene, const Ray& whole, double t_min, double t_max) {
    if (scene.box().empty()) return;
    range = clip(whole, scene.box(), {t_min, t_max});
    if (!range.empty()) ray = {whole.at(range.lo), whole.direction};
  }
  double length() const { return range.hi - range.lo; }
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
  const Entry entry(*scene_, ray, t_min, t_max);
  if (entry.range.empty()) return std::nullopt;
  std::optional<Hit> hit = scene_->first_hit(entry.ray, entry.length());
  if (hit) hit->t += entry.range.lo;
  return hit;
}

bool Tracer::occluded(const Ray& ray, double t_min, double t_max) const {
  const Entry entry(*scene_, ray, t_min, t_max);
  return !entry.range.empty() && scene_->occluded(entry.ray, entry.length());
}

}  // namespace barkridge
