#include "study/crossings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>

#include "base/geometry.h"
#include "raytrace/embree_handles.h"

namespace barkridge {

namespace {

using Corners = std::array<Vec3, 3>;

// Six times the signed volume of a tetrahedron.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

// Whether the segment from p to q passes through the triangle.
bool passes(const Vec3& p, const Vec3& q, const Corners& t) {
  if (volume(t[0], t[1], t[2], p) * volume(t[0], t[1], t[2], q) >= 0) return false;
  const double u = volume(p, q, t[0], t[1]), v = volume(p, q, t[1], t[2]), w = volume(p, q, t[2], t[0]);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

// Two triangles that are not in one plane cross where an edge of one passes through the other.
bool cross(const Corners& a, const Corners& b) {
  for (int i = 0; i < 3; ++i) {
    if (passes(a[i], a[(i + 1) % 3], b) || passes(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

struct Counter {
  const Mesh& mesh;
  std::atomic<std::size_t> pairs{0};

  Corners corners(std::uint32_t t) const {
    const auto& triangle = mesh.triangles[t];
    return {Vec3(mesh.positions[triangle[0]]), Vec3(mesh.positions[triangle[1]]), Vec3(mesh.positions[triangle[2]])};
  }
  bool share_vertex(std::uint32_t s, std::uint32_t t) const {
    const auto& others = mesh.triangles[t];
    return std::any_of(mesh.triangles[s].begin(), mesh.triangles[s].end(), [&](std::uint32_t vertex) {
      return std::find(others.begin(), others.end(), vertex) != others.end();
    });
  }
};

void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  const Counter& counter = *static_cast<const Counter*>(arguments->geometryUserPtr);
  const Corners corners = counter.corners(arguments->primID);
  const Vec3 lo = glm::min(glm::min(corners[0], corners[1]), corners[2]),
             hi = glm::max(glm::max(corners[0], corners[1]), corners[2]);
  RTCBounds& out = *arguments->bounds_o;
  // Positions are floats, so that nothing is rounded.
  out.lower_x = static_cast<float>(lo.x);
  out.lower_y = static_cast<float>(lo.y);
  out.lower_z = static_cast<float>(lo.z);
  out.upper_x = static_cast<float>(hi.x);
  out.upper_y = static_cast<float>(hi.y);
  out.upper_z = static_cast<float>(hi.z);
}

// Embree tells pairs of boxes that overlap, each in both orders.
void collide_callback(void* user, RTCCollision* collisions, unsigned int count) {
  Counter& counter = *static_cast<Counter*>(user);
  std::size_t found = 0;
  for (unsigned int i = 0; i < count; ++i) {
    const std::uint32_t s = collisions[i].primID0, t = collisions[i].primID1;
    if (s < t && !counter.share_vertex(s, t) && cross(counter.corners(s), counter.corners(t))) ++found;
  }
  counter.pairs += found;
}

}  // namespace

std::size_t crossing_pairs(const Mesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  Counter counter{mesh};
  const DeviceHandle device(rtcNewDevice(nullptr));
  if (!device) throw std::runtime_error("Embree cannot start on this machine");
  const SceneHandle scene(rtcNewScene(device.get()));
  const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(mesh.triangles.size()));
  rtcSetGeometryUserData(geometry, &counter);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
  rtcCollide(scene.get(), scene.get(), collide_callback, &counter);
  return counter.pairs;
}

}  // namespace barkridge
