#pragma once
// What a tracer traverses with Embree: the cells of a field, or the triangles of a mesh.

#include <memory>
#include <optional>
#include <span>

#include "blobtree/field.h"
#include "mesh/mesh.h"
#include "raytrace/embree_handles.h"
#include "raytrace/tracer.h"

namespace barkridge {

/// A scene in Embree. Embree works in floats, so it sees everything moved to the origin and scaled to half diagonal 1,
/// and rays that start where they enter the scene's box.
class TracedScene {
 public:
  virtual ~TracedScene() = default;

  /// Boxes that together hold everything.
  virtual std::size_t part_count() const = 0;
  virtual Box part(std::size_t index) const = 0;

  /// As `Tracer` has them, for rays that start in `box()` and for t in their ranges, which start at 0.
  virtual void first_hits(const RayBundle& bundle, std::span<std::optional<Hit>> hits) const = 0;
  virtual RayLanes occluded(const RayBundle& bundle) const = 0;

  const Box& box() const { return box_; }
  double tolerance() const { return 0x1p-24 * box_.diagonal(); }

 protected:
  /// What rounding shifts a plane by in Embree, along any ray, is a tenth of this margin, in its measures.
  static constexpr double kFloatMargin = 2e-6;

  /// To be called when parts are known: measures the scene and starts Embree.
  void begin();
  /// Makes `geometry`, which it takes, the scene's only one.
  void commit(RTCGeometry geometry);

  RTCDevice device() const { return device_.get(); }
  RTCScene embree() const { return embree_.get(); }
  double scale() const { return scale_; }
  Vec3 to_unit(const Vec3& point) const { return (point - center_) * scale_; }
  RTCRay unit_ray(const Ray& ray, double length) const;

 private:
  Box box_;
  Vec3 center_{0};
  double scale_ = 1;
  DeviceHandle device_;
  SceneHandle embree_;
};

/// Both throw `std::bad_alloc` where Embree has no room. The first keeps what it needs of the field, the second of the
/// mesh: triangles without an area are never met.
std::unique_ptr<const TracedScene> traced_scene(const Field& field);
std::unique_ptr<const TracedScene> traced_scene(const Mesh& mesh);

}  // namespace barkridge
