#include "scene/camera_fit.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "blobtree/tree.h"
#include "scene/solid_bounds.h"

using namespace barkridge;

namespace {

struct Ball {
  Vec3 center;
  double radius;
};
const std::vector<Ball> kBalls = {{{-1, 0, -2}, 1}, {{3, 10, 1}, 0.5}, {{0, 6, 4}, 2}};

std::shared_ptr<const Field> balls() {
  BlobTree tree;
  std::vector<NodeId> children;
  for (const Ball& ball : kBalls)
    children.push_back(tree.add(Cone{ball.center, ball.center, ball.radius, ball.radius}));
  tree.add(Union{}, children);
  return compile(tree);
}

// The largest coordinate of points all over the balls in the picture, whose edges are at 1; infinite if one is behind
// the camera.
double reach_in_picture(const Camera& camera, double aspect) {
  const Vec3 forward = glm::normalize(camera.target - camera.position);
  const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
  const Vec3 up = glm::cross(right, forward);
  double reach = 0;
  for (const Ball& ball : kBalls) {
    for (int i = 0; i < 2000; ++i) {
      const double y = 2 * random_unit(5, i) - 1, angle = 2 * M_PI * random_unit(6, i);
      const Vec3 outward(std::sqrt(1 - y * y) * std::cos(angle), y, std::sqrt(1 - y * y) * std::sin(angle));
      const Vec3 v = ball.center + ball.radius * outward - camera.position;
      const double depth = glm::dot(v, forward);
      if (depth <= 0) return std::numeric_limits<double>::infinity();
      const double half_height = camera.projection == Camera::Projection::kPerspective
                                     ? depth * std::tan(camera.fov_degrees * M_PI / 360)
                                     : camera.height / 2;
      reach = std::max(
          {reach, std::abs(glm::dot(v, up)) / half_height, std::abs(glm::dot(v, right)) / (half_height * aspect)});
    }
  }
  return reach;
}

}  // namespace

TEST_CASE("a fitted camera shows the whole model and wastes little, from every side") {
  const std::shared_ptr<const Field> field = balls();
  for (int i = 0; i < 200; ++i) {
    SceneCamera camera;
    camera.projection = i % 2 ? Camera::Projection::kPerspective : Camera::Projection::kOrthographic;
    camera.azimuth_degrees = 360 * random_unit(1, i);
    camera.elevation_degrees = i % 20 == 0 ? 90 : i % 20 == 1 ? -90 : 180 * random_unit(2, i) - 90;
    camera.fov_degrees = 5 + 100 * random_unit(3, i);
    const double aspect = 0.3 + 3 * random_unit(4, i);
    const double reach = reach_in_picture(fit_camera(camera, *field, aspect), aspect);
    CAPTURE(camera.azimuth_degrees, camera.elevation_degrees, camera.fov_degrees, aspect);
    CHECK(reach <= 1);
    CHECK(reach >= 0.9);
  }
}

TEST_CASE("zoom magnifies the middle of the picture by its factor") {
  const std::shared_ptr<const Field> field = balls();
  for (const auto projection : {Camera::Projection::kPerspective, Camera::Projection::kOrthographic}) {
    SceneCamera camera;
    camera.projection = projection;
    const double once = reach_in_picture(fit_camera(camera, *field, 1), 1);
    camera.zoom = 5;
    CHECK(reach_in_picture(fit_camera(camera, *field, 1), 1) == Approx(5 * once));
  }
}

TEST_CASE("what a scene says of its camera stays as it is") {
  const std::shared_ptr<const Field> field = balls();
  SceneCamera camera;
  camera.position = Vec3(1, 2, 30);
  camera.target = Vec3(0, 1, 0);
  camera.fov_degrees = 20;
  const Camera fitted = fit_camera(camera, *field, 1);
  CHECK(fitted.position == Vec3(1, 2, 30));
  CHECK(fitted.target == Vec3(0, 1, 0));
  CHECK(fitted.fov_degrees == 20);
  camera.target.reset();
  CHECK(fit_camera(camera, *field, 1).target == solid_bounds(*field).center());
}

TEST_CASE("azimuth turns from +z towards +x and elevation rises above the horizon") {
  const auto close = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-12; };
  CHECK(close(direction_of_angles(0, 0), Vec3(0, 0, 1)));
  CHECK(close(direction_of_angles(90, 0), Vec3(1, 0, 0)));
  CHECK(close(direction_of_angles(45, 90), Vec3(0, 1, 0)));
}

TEST_CASE("an empty model has a camera too") {
  const Camera camera = fit_camera({}, *compile(BlobTree{}), 1);
  CHECK(std::isfinite(camera.position.x));
  CHECK(camera.target == Vec3(0));
}
