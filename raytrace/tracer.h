#pragma once
// Rays against the solid of a field, or against a mesh.

#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "base/progress.h"
#include "blobtree/field.h"
#include "mesh/mesh.h"

namespace barkridge {

/// Where a ray meets a surface.
struct Hit {
  double t = 0;
  Vec3 point{0};
  /// Unit normal for shading: a field's gradient, or the mix of a mesh's vertex normals. Outward, or against the ray
  /// where a gradient vanishes; of a mesh met from behind, the normal of that side.
  Vec3 normal{0};
  /// The unit normal of the surface itself, which for a field is the same.
  Vec3 outward{0};
  /// A distance along `outward` at which other rays can start without meeting this same surface again: small against
  /// all features, and never less than the tracer's tolerance allows.
  double clearance = 0;

  Vec3 outside_point() const { return point + clearance * outward; }
};

/// A ray, where it matters.
struct RayPart {
  Ray ray;
  Interval range{0, std::numeric_limits<double>::infinity()};
};

class TracedScene;

/// Finds where rays meet the solid { F >= kIsoValue }, or the triangles of a mesh. Immutable; every member may be
/// called from many threads at once.
class Tracer {
 public:
  /// Prepares field or mesh for rays, on all threads. Keeps no reference to field or mesh. Throws `Cancelled` by
  /// `progress`.
  explicit Tracer(const Field& field, const Progress& progress = {});
  explicit Tracer(const Mesh& mesh, const Progress& progress = {});
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  /// The first point of the solid along the ray (of a mesh, of its triangles, from either side) with t in [t_min,
  /// t_max]; that is t_min for a ray that starts inside. Nothing is missed that is thicker than `tolerance()` along the
  /// ray and that the field exceeds the iso-value in by more than 1e-5, at any distance; t is exact to `tolerance()`.
  std::optional<Hit> first_hit(const Ray& ray, double t_min = 0,
                               double t_max = std::numeric_limits<double>::infinity()) const;

  /// Whether `first_hit` would find something. Cheaper.
  bool occluded(const Ray& ray, double t_min = 0, double t_max = std::numeric_limits<double>::infinity()) const;

  /// Up to `kMostTogether` rays at once that lie near each other, like those of neighbouring pixels: several times
  /// cheaper than one by one. What is found depends, within the tolerance, on which rays are traced together.
  static constexpr std::size_t kMostTogether = RayBundle::kWidth;
  void first_hits(std::span<const RayPart> rays, std::span<std::optional<Hit>> hits) const;
  void occluded(std::span<const RayPart> rays, std::span<bool> are_occluded) const;

  /// Boxes that together hold all that there is to meet: a field's cells, a mesh's triangles.
  std::size_t part_count() const;
  Box part(std::size_t index) const;
  /// Holds them; empty when there is nothing.
  const Box& scene_box() const;
  /// 6e-8 of the diagonal of `scene_box()`.
  double tolerance() const;

 private:
  std::unique_ptr<const TracedScene> scene_;
};

}  // namespace barkridge
