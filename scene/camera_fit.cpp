#include "scene/camera_fit.h"

#include <cmath>
#include <glm/trigonometric.hpp>

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

// How far from `target` the camera must stand, and how high an orthographic picture must be, to show the whole box.
struct Extent {
  double distance = 0, height = 0;
};
Extent needed_extent(const Box& box, const Vec3& target, const Frame& frame, double tangent, double aspect) {
  Extent extent;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p =
        Vec3(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z) -
        target;
    const double y = std::max(std::abs(glm::dot(p, frame.up)), std::abs(glm::dot(p, frame.right)) / aspect);
    extent.distance = std::max(extent.distance, glm::dot(p, frame.back) + kMargin * y / tangent);
    extent.height = std::max(extent.height, 2 * kMargin * y);
  }
  return extent;
}

}  // namespace

Vec3 direction_of_angles(double azimuth_degrees, double elevation_degrees) {
  const double azimuth = glm::radians(azimuth_degrees), elevation = glm::radians(elevation_degrees);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

Camera fit_camera(const SceneCamera& camera, const Box& model, double aspect) {
  const Box box = model.empty() ? Box{Vec3(-1), Vec3(1)} : model;
  Camera fitted;
  fitted.projection = camera.projection;
  fitted.fov_degrees = camera.fov_degrees;
  fitted.target = camera.target.value_or(box.center());
  const Vec3 back = camera.position ? glm::normalize(*camera.position - fitted.target)
                                    : direction_of_angles(camera.azimuth_degrees, camera.elevation_degrees);
  const Frame frame = frame_of(back, camera.up, camera.azimuth_degrees);
  const double tangent = std::tan(glm::radians(camera.fov_degrees) / 2);
  const Extent extent = needed_extent(box, fitted.target, frame, tangent, aspect);
  const bool orthographic = camera.projection == Camera::Projection::kOrthographic;
  const double distance = orthographic ? glm::length(fitted.target - box.center()) + box.diagonal() : extent.distance;
  fitted.position = camera.position.value_or(fitted.target + back * distance);
  // A longer lens, not a nearer camera, so that no zoom takes the camera into the model.
  if (!camera.position) fitted.fov_degrees = glm::degrees(2 * std::atan(tangent / camera.zoom));
  fitted.height = camera.height.value_or(extent.height / camera.zoom);
  fitted.up = frame.up;
  return fitted;
}

}  // namespace barkridge
