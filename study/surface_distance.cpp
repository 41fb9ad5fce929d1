#include "study/surface_distance.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>

#include "raytrace/embree_handles.h"

namespace barkridge {

namespace {

// The point of triangle a, b, c nearest to p, by the region of the triangle's plane that p lies over. A triangle
// without an area is as good as its edges. [Ericson 2005, "Real-Time Collision Detection", 5.1.5]
Vec3 nearest_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Vec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

struct NearestPoint::Tree {
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  DeviceHandle device;
  SceneHandle scene;

  explicit Tree(const Mesh& mesh) : positions(mesh.positions), triangles(mesh.triangles) {
    device.reset(rtcNewDevice(nullptr));
    if (!device) throw std::runtime_error("Embree cannot start on this machine");
    scene.reset(rtcNewScene(device.get()));
    const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   sizeof(positions[0]), positions.size());
    void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  sizeof(triangles[0]), triangles.size());
    if (!vertices || !indices) throw std::bad_alloc();
    std::memcpy(vertices, positions.data(), positions.size() * sizeof(positions[0]));
    std::memcpy(indices, triangles.data(), triangles.size() * sizeof(triangles[0]));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
  }
};

NearestPoint::NearestPoint(const Mesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}
NearestPoint::~NearestPoint() = default;
NearestPoint::NearestPoint(NearestPoint&&) noexcept = default;

double NearestPoint::distance(const Vec3& point) const {
  struct Query {
    const Tree* tree;
    Vec3 point;
    double squared = std::numeric_limits<double>::infinity();
  } query{tree_.get(), point};
  // Embree only rules out boxes, in floats; the distances are taken in double precision.
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
    Query& q = *static_cast<Query*>(arguments->userPtr);
    const auto& corners = q.tree->triangles[arguments->primID];
    const auto& positions = q.tree->positions;
    const Vec3 nearest = nearest_of_triangle(q.point, Vec3(positions[corners[0]]), Vec3(positions[corners[1]]),
                                             Vec3(positions[corners[2]]));
    const Vec3 offset = q.point - nearest;
    const double squared = glm::dot(offset, offset);
    if (!(squared < q.squared)) return false;
    q.squared = squared;
    arguments->query->radius =
        std::nextafter(static_cast<float>(std::sqrt(squared)), std::numeric_limits<float>::max());
    return true;
  };
  RTCPointQuery around{};
  around.x = static_cast<float>(point.x);
  around.y = static_cast<float>(point.y);
  around.z = static_cast<float>(point.z);
  around.radius = std::numeric_limits<float>::infinity();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(tree_->scene.get(), &around, &context, visit, &query);
  return std::sqrt(query.squared);
}

std::vector<Vec3> points_of(const Mesh& mesh) {
  std::vector<Vec3> points(mesh.positions.begin(), mesh.positions.end());
  points.reserve(points.size() + 4 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]), c(mesh.positions[triangle[2]]);
    points.insert(points.end(), {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0});
  }
  return points;
}

double DistanceSummary::root_mean_square() const { return std::sqrt(mean_square); }

DistanceSummary summary(std::span<const double> distances) {
  DistanceSummary result{0, 0, distances.size()};
  for (const double distance : distances) {
    result.largest = std::max(result.largest, distance);
    result.mean_square += distance * distance;
  }
  if (result.count > 0) result.mean_square /= static_cast<double>(result.count);
  return result;
}

DistanceSummary unite(const DistanceSummary& a, const DistanceSummary& b) {
  const double m = static_cast<double>(a.count), n = static_cast<double>(b.count);
  const double mean = m + n > 0 ? (a.mean_square * m + b.mean_square * n) / (m + n) : 0;
  return {std::max(a.largest, b.largest), mean, a.count + b.count};
}

DistanceSummary distances(std::span<const Vec3> points, const NearestPoint& to) {
  std::vector<double> found(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { found[i] = to.distance(points[i]); });
  return summary(found);
}

DistanceSummary two_sided_distance(const Mesh& a, const Mesh& b) {
  return unite(distances(points_of(a), NearestPoint(b)), distances(points_of(b), NearestPoint(a)));
}

}  // namespace barkridge
