// Meshes for a tracer: Embree's own triangles, with the vertices' normals.

#include <cmath>
#include <cstring>
#include <new>

#include "raytrace/traced_scene.h"

namespace barkridge {

namespace {

Vec3 mixed(const std::array<std::uint32_t, 3>& corners, const std::vector<glm::vec3>& of, double u, double v) {
  return (1 - u - v) * Vec3(of[corners[0]]) + u * Vec3(of[corners[1]]) + v * Vec3(of[corners[2]]);
}

class MeshScene final : public TracedScene {
 public:
  explicit MeshScene(const Mesh& mesh)
      : positions_(mesh.positions), normals_(mesh.normals), triangles_(mesh.triangles) {
    if (triangles_.empty()) return;
    begin();
    // Meshes are closed along shared edges, and robust traversal lets no ray pass between their triangles.
    rtcSetSceneFlags(embree(), RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions_.size()));
    auto* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  sizeof(triangles_[0]), triangles_.size());
    if (!vertices || !indices) throw std::bad_alloc();
    for (std::size_t i = 0; i < positions_.size(); ++i) vertices[i] = glm::vec3(to_unit(Vec3(positions_[i])));
    std::memcpy(indices, triangles_.data(), triangles_.size() * sizeof(triangles_[0]));
    commit(geometry);
  }

  std::size_t part_count() const override { return triangles_.size(); }
  Box part(std::size_t index) const override {
    Box box;
    for (const std::uint32_t vertex : triangles_[index]) box = unite(box, Vec3(positions_[vertex]));
    return box;
  }

  void first_hits(const RayBundle& bundle, std::span<std::optional<Hit>> hits) const override {
    for_each_lane(bundle.lanes(),
                  [&](std::size_t lane) { hits[lane] = first_hit(bundle.ray(lane), bundle.ranges.hi[lane]); });
  }

  RayLanes occluded(const RayBundle& bundle) const override {
    RayLanes rays = 0;
    for_each_lane(bundle.lanes(), [&](std::size_t lane) {
      if (is_occluded(bundle.ray(lane), bundle.ranges.hi[lane])) rays |= RayLanes{1} << lane;
    });
    return rays;
  }

 private:
  std::optional<Hit> first_hit(const Ray& ray, double length) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit rayhit{unit_ray(ray, length), {}};
    rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree(), &context, &rayhit);
    if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

    // Embree's place within the triangle is exact enough; the point is found again in double precision from it.
    const auto& corners = triangles_[rayhit.hit.primID];
    const double u = static_cast<double>(rayhit.hit.u), v = static_cast<double>(rayhit.hit.v);
    const Vec3 point = mixed(corners, positions_, u, v), origin(positions_[corners[0]]);
    Vec3 flat =
        glm::normalize(glm::cross(Vec3(positions_[corners[1]]) - origin, Vec3(positions_[corners[2]]) - origin));
    Vec3 normal = normals_.empty() ? flat : mixed(corners, normals_, u, v);
    const double size = glm::length(normal);
    normal = size > 0 ? normal / size : flat;
    // An open surface has two outer sides.
    if (glm::dot(flat, ray.direction) > 0) {
      flat = -flat;
      normal = -normal;
    }
    return Hit{glm::dot(point - ray.origin, ray.direction), point, normal, flat, 64 * tolerance()};
  }

  bool is_occluded(const Ray& ray, double length) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay unit = unit_ray(ray, length);
    rtcOccluded1(embree(), &context, &unit);
    return unit.tfar < 0;
  }

  std::vector<glm::vec3> positions_, normals_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::unique_ptr<const TracedScene> traced_scene(const Mesh& mesh) { return std::make_unique<MeshScene>(mesh); }

}  // namespace barkridge
