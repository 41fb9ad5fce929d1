#include "raytrace/camera.h"

#include <cmath>
#include <numbers>

namespace barkridge {

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : perspective_(camera.projection == Camera::Projection::kPerspective),
      position_(camera.position),
      view_(glm::normalize(camera.target - camera.position)),
      width_(width),
      height_(height) {
  const double half = perspective_ ? std::tan(0.5 * camera.fov_degrees * std::numbers::pi / 180) : 0.5 * camera.height;
  const Vec3 right = glm::normalize(glm::cross(view_, camera.up));
  right_ = half * right;
  down_ = half * glm::cross(view_, right);
}

Ray CameraRays::through(double x, double y) const {
  const double across = (2 * x - width_) / height_, down = 2 * y / height_ - 1;
  const Vec3 offset = across * right_ + down * down_;
  if (perspective_) return {position_, glm::normalize(view_ + offset)};
  return {position_ + offset, view_};
}

Footprint CameraRays::footprint() const {
  const double pixel = 2 * glm::length(right_) / height_;
  return perspective_ ? Footprint{0, pixel} : Footprint{pixel, 0};
}

std::optional<glm::dvec2> CameraRays::place_of(const Vec3& point) const {
  const Vec3 offset = point - position_;
  const double depth = glm::dot(offset, view_);
  if (perspective_ && !(depth > 1e-6 * glm::length(offset))) return std::nullopt;
  const double half2 = glm::dot(right_, right_) * (perspective_ ? depth : 1);
  const double across = glm::dot(offset, right_) / half2, down = glm::dot(offset, down_) / half2;
  return glm::dvec2(0.5 * (across * height_ + width_), 0.5 * (down + 1) * height_);
}

}  // namespace barkridge
