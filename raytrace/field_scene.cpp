// Fields for a tracer: Embree traverses the boxes of the field's cells, and the cells answer for what is in them.

#include <algorithm>
#include <cmath>

#include "raytrace/traced_scene.h"

namespace barkridge {

namespace {

// The rays as the callbacks need them, found again through the first member's address.
struct Query {
  RTCIntersectContext context;
  const RayBundle& bundle;
  RayLanes hits = 0;
  RayRanges::Column limits;  // where the nearest point yet known is
  std::array<SurfacePoint, RayBundle::kWidth> found;

  explicit Query(const RayBundle& rays) : bundle(rays) {
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    limits.fill(std::numeric_limits<double>::infinity());
  }
};

// Which rays of the bundle a callback is about: Embree may pass on some of a packet only.
struct Packet {
  RTCRayN* rays;
  unsigned width;
  RayLanes lanes = 0;

  Packet(const int* valid, RTCRayN* of, unsigned count) : rays(of), width(count) {
    for (unsigned i = 0; i < count; ++i) {
      lanes |= (valid[i] != 0 ? RayLanes{1} : 0) << (is_whole() ? i : RTCRayN_id(rays, width, i));
    }
  }

  float& reach(std::size_t lane) const {
    auto i = static_cast<unsigned>(lane);
    if (!is_whole()) {
      for (i = 0; RTCRayN_id(rays, width, i) != lane;) ++i;
    }
    return RTCRayN_tfar(rays, width, i);
  }

 private:
  bool is_whole() const { return width == RayBundle::kWidth; }
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

  void first_hits(const RayBundle& bundle, std::span<std::optional<Hit>> hits) const override {
    Query query(bundle);
    if (bundle.count == 1) {
      RTCRayHit rayhit{unit_ray(bundle.ray(0), bundle.ranges.hi[0]), {}};
      rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(embree(), &query.context, &rayhit);
    } else {
      RTCRayHit16 packet;
      std::fill_n(packet.hit.geomID, RayBundle::kWidth, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(packet.hit.instID[0], RayBundle::kWidth, RTC_INVALID_GEOMETRY_ID);
      const Valid valid = fill(bundle, packet.ray);
      rtcIntersect16(valid.data(), embree(), &query.context, &packet);
    }
    for_each_lane(query.hits, [&](std::size_t lane) { hits[lane] = hit_at(bundle.ray(lane), query.found[lane]); });
  }

  RayLanes occluded(const RayBundle& bundle) const override {
    Query query(bundle);
    if (bundle.count == 1) {
      RTCRay unit = unit_ray(bundle.ray(0), bundle.ranges.hi[0]);
      rtcOccluded1(embree(), &query.context, &unit);
    } else {
      RTCRay16 packet;
      const Valid valid = fill(bundle, packet);
      rtcOccluded16(valid.data(), embree(), &query.context, &packet);
    }
    return query.hits;
  }

 private:
  struct alignas(64) Valid : std::array<int, RayBundle::kWidth> {};
  static_assert(RayBundle::kWidth == 16);

  Valid fill(const RayBundle& bundle, RTCRay16& packet) const {
    Valid valid;
    for (std::size_t i = 0; i < RayBundle::kWidth; ++i) {
      valid[i] = i < bundle.count ? -1 : 0;
      const RTCRay unit = i < bundle.count ? unit_ray(bundle.ray(i), bundle.ranges.hi[i]) : RTCRay{};
      packet.org_x[i] = unit.org_x;
      packet.org_y[i] = unit.org_y;
      packet.org_z[i] = unit.org_z;
      packet.tnear[i] = unit.tnear;
      packet.dir_x[i] = unit.dir_x;
      packet.dir_y[i] = unit.dir_y;
      packet.dir_z[i] = unit.dir_z;
      packet.time[i] = unit.time;
      packet.tfar[i] = unit.tfar;
      packet.mask[i] = unit.mask;
      packet.id[i] = static_cast<unsigned>(i);
      packet.flags[i] = unit.flags;
    }
    return valid;
  }

  Hit hit_at(const Ray& ray, const SurfacePoint& found) const {
    const auto& [t, gradient] = found;
    const double slope = glm::length(gradient);
    const bool steep = slope > 0 && std::isfinite(slope);
    const Vec3 normal = steep ? -gradient / slope : -ray.direction;
    // A ten-thousandth of the length over which the field changes.
    const double feature = steep ? kIsoValue / slope : 0;
    const double clearance = std::clamp(1e-4 * feature, 4 * tolerance(), 400 * tolerance());
    return Hit{t, ray.at(t), normal, normal, clearance};
  }

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
    const FieldScene& scene = *static_cast<const FieldScene*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    const Packet packet(arguments->valid, RTCRayHitN_RayN(arguments->rayhit, arguments->N), arguments->N);
    std::array<SurfacePoint, RayBundle::kWidth> found;
    const RayLanes hits = scene.cells_->first_inside(arguments->primID, query.bundle, packet.lanes, query.limits,
                                                     scene.tolerance(), found);
    for_each_lane(hits, [&](std::size_t lane) {
      if (found[lane].t >= query.limits[lane]) return;
      query.found[lane] = found[lane];
      query.limits[lane] = found[lane].t;
      query.hits |= RayLanes{1} << lane;
      float& reach = packet.reach(lane);
      reach = std::min(reach, static_cast<float>(found[lane].t * scene.scale() + 2 * kFloatMargin));
    });
  }

  static void occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
    const FieldScene& scene = *static_cast<const FieldScene*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    const Packet packet(arguments->valid, arguments->ray, arguments->N);
    const RayLanes hits = scene.cells_->any_inside(arguments->primID, query.bundle, packet.lanes, scene.tolerance());
    query.hits |= hits;
    for_each_lane(hits, [&](std::size_t lane) { packet.reach(lane) = -std::numeric_limits<float>::infinity(); });
  }

  std::unique_ptr<const SurfaceCells> cells_;
};

}  // namespace

std::unique_ptr<const TracedScene> traced_scene(const Field& field) { return std::make_unique<FieldScene>(field); }

}  // namespace barkridge
