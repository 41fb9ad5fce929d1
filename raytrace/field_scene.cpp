// Fields for a tracer: Embree traverses the boxes of the field's cells, and the cells answer for what is in them.

#include <algorithm>
#include <cmath>

#include "raytrace/traced_scene.h"

namespace barkridge {

namespace {

// The ray as the callbacks need it, found again through the first member's address.
struct Query {
  RTCIntersectContext context;
  const Ray* ray = nullptr;
  double length = 0;
  std::optional<SurfacePoint> found;
};

class FieldScene final : public TracedScene {
 public:
  explicit FieldScene(const Field& field) : cells_(field.cells()) {
    if (cells_->size() == 0) return;
    begin();
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(cells_->size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_callback);
    rtcSetGeometryOccludedFunction(geometry, occluded_callback);
    commit(geometry);
  }

  std::size_t part_count() const override { return cells_->size(); }
  Box part(std::size_t index) const override { return cells_->box(index); }

  std::optional<Hit> first_hit(const Ray& ray, double length) const override {
    Query query{{}, &ray, length, {}};
    rtcInitIntersectContext(&query.context);
    RTCRayHit rayhit{unit_ray(ray, length), {}};
    rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree(), &query.context, &rayhit);
    if (!query.found) return std::nullopt;

    const auto& [t, gradient] = *query.found;
    const double slope = glm::length(gradient);
    const bool steep = slope > 0 && std::isfinite(slope);
    const Vec3 normal = steep ? -gradient / slope : -ray.direction;
    // A ten-thousandth of the length over which the field changes.
    const double feature = steep ? kIsoValue / slope : 0;
    const double clearance = std::clamp(1e-4 * feature, 4 * tolerance(), 400 * tolerance());
    return Hit{t, ray.at(t), normal, normal, clearance};
  }

  bool occluded(const Ray& ray, double length) const override {
    Query query{{}, &ray, length, {}};
    rtcInitIntersectContext(&query.context);
    RTCRay unit = unit_ray(ray, length);
    rtcOccluded1(embree(), &query.context, &unit);
    return unit.tfar < 0;
  }

 private:
  // Boxes are grown, and the reach of rays lengthened, so that Embree need not be robust itself.
  static void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
    const FieldScene& scene = *static_cast<const FieldScene*>(arguments->geometryUserPtr);
    const Box box = scene.cells_->box(arguments->primID);
    const Box unit = grown({scene.to_unit(box.lo), scene.to_unit(box.hi)}, kFloatMargin);
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = static_cast<float>(unit.lo.x);
    out.lower_y = static_cast<float>(unit.lo.y);
    out.lower_z = static_cast<float>(unit.lo.z);
    out.upper_x = static_cast<float>(unit.hi.x);
    out.upper_y = static_cast<float>(unit.hi.y);
    out.upper_z = static_cast<float>(unit.hi.z);
  }

  // The reach that Embree is given never limits the search within a cell: the result is the least t over all cells,
  // whatever the order in which they are visited.
  static void intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
    if (!arguments->valid[0]) return;
    const FieldScene& scene = *static_cast<const FieldScene*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    const double limit = query.found ? query.found->t : std::numeric_limits<double>::infinity();
    const std::optional<SurfacePoint> found =
        scene.cells_->first_inside(arguments->primID, *query.ray, {0, query.length}, limit, scene.tolerance());
    if (!found || found->t >= limit) return;
    query.found = found;
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray;
    ray.tfar = std::min(ray.tfar, static_cast<float>(found->t * scene.scale() + 2 * kFloatMargin));
  }

  static void occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
    if (!arguments->valid[0]) return;
    const FieldScene& scene = *static_cast<const FieldScene*>(arguments->geometryUserPtr);
    const Query& query = *reinterpret_cast<const Query*>(arguments->context);
    if (scene.cells_->any_inside(arguments->primID, *query.ray, {0, query.length}, scene.tolerance())) {
      reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
    }
  }

  std::unique_ptr<const SurfaceCells> cells_;
};

}  // namespace

std::unique_ptr<const TracedScene> traced_scene(const Field& field) { return std::make_unique<FieldScene>(field); }

}  // namespace barkridge
