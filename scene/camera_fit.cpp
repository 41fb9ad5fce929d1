#include "scene/camera_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "scene/solid_bounds.h"

namespace barkridge {

namespace {

constexpr double kMargin = 1.06;

struct Frame {
  Vec3 right, up, back;
};

// `back` points from the target to the camera. Looking straight along `up`, the picture's top is where the azimuth
// points, or where it points away from.
Frame frame_of(const Vec3& back, const Vec3& up, double azimuth_degrees) {
  Vec3 right = glm::cross(up, back);
  if (glm::length(right) <= 1e-9 * glm::length(up)) {
    right = glm::cross(-direction_of_angles(azimuth_degrees, 0) * (glm::dot(up, back) < 0 ? -1.0 : 1.0), back);
  }
  if (glm::length(right) <= 1e-9) right = Vec3(1, 0, 0);
  right = glm::normalize(right);
  return {right, glm::cross(back, right), back};
}

// How far the solid reaches from `target` in a direction; a ball of radius 1 around it where there is none.
double reach_from(const Field& field, const Vec3& target, const Vec3& direction) {
  const std::optional<double> reach = solid_reach(field, direction);
  return reach ? *reach - glm::dot(target, direction) : glm::length(direction);
}

// The distance from `target` at which the solid lies before all four planes that go through the camera and the
// picture's edges.
double needed_distance(const Field& field, const Vec3& target, const Frame& frame, double tangent, double aspect) {
  double distance = 0;
  for (const Vec3& side : {frame.up, -frame.up, frame.right / aspect, -frame.right / aspect}) {
    distance = std::max(distance, reach_from(field, target, frame.back + side * (kMargin / tangent)));
  }
  return distance;
}

double needed_height(const Field& field, const Vec3& target, const Frame& frame, double aspect) {
  double half_height = 0;
  for (const Vec3& side : {frame.up, -frame.up, frame.right / aspect, -frame.right / aspect}) {
    half_height = std::max(half_height, kMargin * reach_from(field, target, side));
  }
  return 2 * half_height;
}

}  // namespace

Vec3 direction_of_angles(double azimuth_degrees, double elevation_degrees) {
  const double azimuth = glm::radians(azimuth_degrees), elevation = glm::radians(elevation_degrees);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

Camera fit_camera(const SceneCamera& camera, const Field& field, double aspect) {
  Camera fitted;
  fitted.projection = camera.projection;
  fitted.fov_degrees = camera.fov_degrees;
  if (camera.target) {
    fitted.target = *camera.target;
  } else {
    const Box solid = solid_bounds(field);
    fitted.target = solid.empty() ? Vec3(0) : solid.center();
  }
  const bool placed = camera.position && *camera.position != fitted.target;
  const Vec3 back = placed ? glm::normalize(*camera.position - fitted.target)
                           : direction_of_angles(camera.azimuth_degrees, camera.elevation_degrees);
  const Frame frame = frame_of(back, camera.up, camera.azimuth_degrees);
  fitted.up = frame.up;
  if (camera.projection == Camera::Projection::kOrthographic) {
    // Anywhere outside of the model will do.
    const Box support = field.support();
    const double outside = support.empty() ? 2 : support.diagonal() + glm::length(support.center() - fitted.target);
    fitted.position = camera.position.value_or(fitted.target + back * outside);
    fitted.height = camera.height ? *camera.height : needed_height(field, fitted.target, frame, aspect) / camera.zoom;
  } else if (camera.position) {
    fitted.position = *camera.position;
  } else {
    const double tangent = std::tan(glm::radians(camera.fov_degrees) / 2);
    fitted.position = fitted.target + back * needed_distance(field, fitted.target, frame, tangent, aspect);
    // A longer lens, not a nearer camera, so that no zoom takes the camera into the model.
    fitted.fov_degrees = glm::degrees(2 * std::atan(tangent / camera.zoom));
  }
  return fitted;
}

}  // namespace barkridge
