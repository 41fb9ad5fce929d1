#pragma once
// Rays against the solid of a field.

#include <limits>
#include <memory>
#include <optional>

#include "base/progress.h"
#include "blobtree/field.h"

namespace barkridge {

/// Where a ray meets the solid.
struct Hit {
  double t = 0;
  Vec3 point{0};
  /// Outward unit normal, by the field's gradient; against the ray where the gradient vanishes.
  Vec3 normal{0};
  /// A distance along the normal at which other rays can start without meeting this same surface again: a
  /// ten-thousandth of the length over which the field changes, and never less than the tracer's tolerance allows.
  double clearance = 0;

  Vec3 outside_point() const { return point + clearance * normal; }
};

/// Finds where rays meet the solid { F >= kIsoValue }. Immutable; every member may be called from many threads at once.
class Tracer {
 public:
  /// Prepares the field for rays, on all threads. Keeps no reference to `field` itself. Throws `Cancelled` by
  /// `progress`.
  explicit Tracer(const Field& field, const Progress& progress = {});
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  /// The first point of the solid along the ray with t in [t_min, t_max]; that is t_min for a ray that starts inside.
  /// Nothing is missed that is thicker than `tolerance()` along the ray and that the field exceeds the iso-value in by
  /// more than 1e-5, at any distance; t is exact to `tolerance()`.
  std::optional<Hit> first_hit(const Ray& ray, double t_min = 0,
                               double t_max = std::numeric_limits<double>::infinity()) const;

  /// Whether `first_hit` would find something. Cheaper.
  bool occluded(const Ray& ray, double t_min = 0, double t_max = std::numeric_limits<double>::infinity()) const;

  /// Those of the field, between which rays are traversed. They live as long as the tracer.
  const SurfaceCells& cells() const;
  /// A box that holds the solid; empty when there is none.
  const Box& scene_box() const;
  /// 6e-8 of the diagonal of `scene_box()`.
  double tolerance() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace barkridge
