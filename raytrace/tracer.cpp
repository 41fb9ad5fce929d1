#include "raytrace/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>

namespace barkridge {

namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using SceneHandle = std::unique_ptr<RTCSceneTy, ReleaseScene>;

// Embree works in floats, so it sees the scene moved to the origin and scaled to half diagonal 1, and rays that start
// where they enter it. There what rounding shifts a box's planes by, along any ray, is a tenth of this margin, by which
// boxes are grown and the reach of rays lengthened; so Embree need not be robust itself.
constexpr double kFloatMargin = 2e-6;

// The ray as the callbacks need it, found again through the first member's address. Its origin is where it enters the
// scene, so that t counts from there and is precise for rays from afar.
struct Query {
  RTCIntersectContext context;
  Ray ray;
  double length = 0;
  std::optional<SurfacePoint> found;
};

}  // namespace

struct Tracer::Scene {
  Box support;
  Vec3 center{0};
  double scale = 1;
  double tolerance = 0;
  std::unique_ptr<const SurfaceCells> cells;
  DeviceHandle device;
  SceneHandle embree;

  bool begin(Query& query, RTCRay& out, const Ray& ray, Interval& range) const;
  void build();
  static void bounds_callback(const RTCBoundsFunctionArguments* arguments);
  static void intersect_callback(const RTCIntersectFunctionNArguments* arguments);
  static void occluded_callback(const RTCOccludedFunctionNArguments* arguments);
};

void Tracer::Scene::bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  const Scene& scene = *static_cast<const Scene*>(arguments->geometryUserPtr);
  const Box box = scene.cells->box(arguments->primID);
  const Box unit = grown({(box.lo - scene.center) * scene.scale, (box.hi - scene.center) * scene.scale}, kFloatMargin);
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
void Tracer::Scene::intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  if (!arguments->valid[0]) return;
  const Scene& scene = *static_cast<const Scene*>(arguments->geometryUserPtr);
  Query& query = *reinterpret_cast<Query*>(arguments->context);
  const double limit = query.found ? query.found->t : std::numeric_limits<double>::infinity();
  const std::optional<SurfacePoint> found =
      scene.cells->first_inside(arguments->primID, query.ray, {0, query.length}, limit, scene.tolerance);
  if (!found || found->t >= limit) return;
  query.found = found;
  RTCRay& ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray;
  ray.tfar = std::min(ray.tfar, static_cast<float>(found->t * scene.scale + 2 * kFloatMargin));
}

void Tracer::Scene::occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  if (!arguments->valid[0]) return;
  const Scene& scene = *static_cast<const Scene*>(arguments->geometryUserPtr);
  const Query& query = *reinterpret_cast<const Query*>(arguments->context);
  if (scene.cells->any_inside(arguments->primID, query.ray, {0, query.length}, scene.tolerance)) {
    reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
  }
}

void Tracer::Scene::build() {
  device.reset(rtcNewDevice(nullptr));
  if (!device) throw std::runtime_error("Embree cannot start on this machine");
  embree.reset(rtcNewScene(device.get()));
  const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(cells->size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embree.get());
  const RTCError error = rtcGetDeviceError(device.get());
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree failed with error " + std::to_string(error));
}

// Sets up a query and Embree's ray for it. False when the ray misses everything. `range` becomes the part within the
// scene.
bool Tracer::Scene::begin(Query& query, RTCRay& out, const Ray& ray, Interval& range) const {
  if (cells->size() == 0) return false;
  range = clip(ray, support, range);
  if (range.empty()) return false;
  query.ray = {ray.at(range.lo), ray.direction};
  query.length = range.hi - range.lo;
  rtcInitIntersectContext(&query.context);
  const Vec3 origin = (query.ray.origin - center) * scale;
  out = {};
  out.org_x = static_cast<float>(origin.x);
  out.org_y = static_cast<float>(origin.y);
  out.org_z = static_cast<float>(origin.z);
  out.dir_x = static_cast<float>(ray.direction.x);
  out.dir_y = static_cast<float>(ray.direction.y);
  out.dir_z = static_cast<float>(ray.direction.z);
  out.tfar = static_cast<float>(query.length * scale + 2 * kFloatMargin);
  out.mask = ~0u;
  return true;
}

Tracer::Tracer(const Field& field, const Progress& progress) : scene_(std::make_unique<Scene>()) {
  report(progress, 0);
  scene_->cells = field.cells();
  const std::size_t count = scene_->cells->size();
  if (count == 0) return;
  for (std::size_t i = 0; i < count; ++i) scene_->support = unite(scene_->support, scene_->cells->box(i));
  const double diagonal = scene_->support.diagonal();
  scene_->center = scene_->support.center();
  scene_->scale = diagonal > 0 ? 2 / diagonal : 1;
  scene_->tolerance = 0x1p-24 * diagonal;
  scene_->build();
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

const SurfaceCells& Tracer::cells() const { return *scene_->cells; }
const Box& Tracer::scene_box() const { return scene_->support; }
double Tracer::tolerance() const { return scene_->tolerance; }

std::optional<Hit> Tracer::first_hit(const Ray& ray, double t_min, double t_max) const {
  Query query{};
  RTCRayHit rayhit;
  Interval range{t_min, t_max};
  if (!scene_->begin(query, rayhit.ray, ray, range)) return std::nullopt;
  rayhit.hit = {};
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_->embree.get(), &query.context, &rayhit);
  if (!query.found) return std::nullopt;

  const auto& [t, gradient] = *query.found;
  const Vec3 point = query.ray.at(t);
  const double slope = glm::length(gradient);
  const bool steep = slope > 0 && std::isfinite(slope);
  Hit hit{range.lo + t, point, steep ? -gradient / slope : -ray.direction, 0};
  const double feature = steep ? kIsoValue / slope : 0;
  hit.clearance = std::clamp(1e-4 * feature, 4 * scene_->tolerance, 400 * scene_->tolerance);
  return hit;
}

bool Tracer::occluded(const Ray& ray, double t_min, double t_max) const {
  Query query{};
  RTCRay out;
  Interval range{t_min, t_max};
  if (!scene_->begin(query, out, ray, range)) return false;
  rtcOccluded1(scene_->embree.get(), &query.context, &out);
  return out.tfar < 0;
}

}  // namespace barkridge
