#include "raytrace/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "raytrace/clip.h"

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
// where they enter it. There its errors stay well below this margin, by which boxes are grown and the reach of rays
// lengthened.
constexpr double kFloatMargin = 1e-6;

// A box that may hold part of the solid, and the model restricted to it once a ray has come by. Whichever thread gets
// there first leaves its restriction for all; they are equal.
class SurfaceCell {
 public:
  SurfaceCell() = default;
  SurfaceCell(const SurfaceCell&) = delete;
  SurfaceCell& operator=(const SurfaceCell&) = delete;
  ~SurfaceCell() { delete restricted_.load(); }

  const Field& field(const Field& model) const {
    const FieldPtr* known = restricted_.load(std::memory_order_acquire);
    return known ? **known : restrict_now(model);
  }

  Box box;

 private:
  using FieldPtr = std::shared_ptr<const Field>;

  const Field& restrict_now(const Field& model) const {
    auto mine = std::make_unique<const FieldPtr>(model.restricted(box));
    const FieldPtr* known = nullptr;
    if (restricted_.compare_exchange_strong(known, mine.get(), std::memory_order_acq_rel)) return **mine.release();
    return **known;
  }

  mutable std::atomic<const FieldPtr*> restricted_ = nullptr;
};

// The ray as the callbacks need it, found again through the first member's address. Its origin is where it enters the
// scene, so that t counts from there and is precise for rays from afar.
struct Query {
  RTCIntersectContext context;
  Ray ray;
  double length = 0;
  double t = std::numeric_limits<double>::infinity();
  const SurfaceCell* cell = nullptr;
};

}  // namespace

struct Tracer::Scene {
  Box support;
  Vec3 center{0};
  double scale = 1;
  double tolerance = 0;
  std::shared_ptr<const Field> model;
  std::vector<SurfaceCell> cells;
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
  const Box& box = scene.cells[arguments->primID].box;
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
  const SurfaceCell& cell = scene.cells[arguments->primID];
  const Interval range = clip(query.ray, cell.box, {0, query.length});
  if (range.empty() || range.lo >= query.t) return;
  const std::optional<double> t = cell.field(*scene.model).first_inside(query.ray, range, scene.tolerance);
  if (!t || *t >= query.t) return;
  query.t = *t;
  query.cell = &cell;
  RTCRay& ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray;
  ray.tfar = std::min(ray.tfar, static_cast<float>(*t * scene.scale + 2 * kFloatMargin));
}

void Tracer::Scene::occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  if (!arguments->valid[0]) return;
  const Scene& scene = *static_cast<const Scene*>(arguments->geometryUserPtr);
  const Query& query = *reinterpret_cast<const Query*>(arguments->context);
  const SurfaceCell& cell = scene.cells[arguments->primID];
  const Interval range = clip(query.ray, cell.box, {0, query.length});
  if (range.empty()) return;
  if (cell.field(*scene.model).any_inside(query.ray, range, scene.tolerance)) {
    reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
  }
}

void Tracer::Scene::build() {
  device.reset(rtcNewDevice(nullptr));
  if (!device) throw std::runtime_error("Embree cannot start on this machine");
  embree.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(embree.get(), RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(cells.size()));
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
  if (cells.empty()) return false;
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
  const std::vector<Box> boxes = field.cover();
  scene_->model = field.restricted(field.support());
  scene_->cells = std::vector<SurfaceCell>(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) scene_->cells[i].box = boxes[i];
  if (scene_->cells.empty()) return;
  for (const SurfaceCell& cell : scene_->cells) scene_->support = unite(scene_->support, cell.box);
  const double diagonal = scene_->support.diagonal();
  scene_->center = scene_->support.center();
  scene_->scale = diagonal > 0 ? 2 / diagonal : 1;
  scene_->tolerance = 0x1p-24 * diagonal;
  scene_->build();
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

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
  if (!query.cell) return std::nullopt;

  const Vec3 point = glm::clamp(query.ray.at(query.t), query.cell->box.lo, query.cell->box.hi);
  double value = 0;
  Vec3 gradient{0};
  query.cell->field(*scene_->model).values_and_gradients({&point, 1}, {&value, 1}, {&gradient, 1});
  const double slope = glm::length(gradient);
  const bool steep = slope > 0 && std::isfinite(slope);
  Hit hit{range.lo + query.t, point, steep ? -gradient / slope : -ray.direction, 0};
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
