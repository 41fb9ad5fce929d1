// What the renderer refuses, in the words of the settings.

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "raytrace/render.h"

namespace barkridge {

namespace {

// Coordinates beyond are certainly mistakes, and would lose the precision that is promised.
constexpr double kFarthest = 1e9;
constexpr double kBrightest = 1e6;
constexpr int kLongestSide = 65536;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 31;
constexpr int kMostSamples = 65536;

[[noreturn]] void refuse(const std::string& name, const std::string& message) {
  throw InputError(name + ": " + message);
}

void check_range(const std::string& name, double value, double lo, double hi) {
  if (!(value >= lo && value <= hi))
    refuse(name, fmt::format("expected a number from {} to {}, not {}", lo, hi, value));
}

void check_color(const std::string& name, const Color& color, double most) {
  for (int c = 0; c < 3; ++c) {
    if (!(color[c] >= 0 && color[c] <= most)) {
      refuse(name, fmt::format("expected three numbers from 0 to {}, not {} {} {}", most, color.x, color.y, color.z));
    }
  }
}

void check_vector(const std::string& name, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(v[axis]) <= kFarthest)) {
      refuse(name, fmt::format("expected three numbers no larger than {}, not {} {} {}", kFarthest, v.x, v.y, v.z));
    }
  }
}

void check_direction(const std::string& name, const Vec3& v) {
  check_vector(name, v);
  if (!(glm::length(v) >= 1e-9)) refuse(name, "expected a direction, but its length is 0");
}

void check_camera(const Camera& camera) {
  check_vector("camera.position", camera.position);
  check_vector("camera.target", camera.target);
  check_direction("camera.up", camera.up);
  const Vec3 view = camera.target - camera.position;
  if (!(glm::length(view) >= 1e-9)) refuse("camera.target", "must differ from camera.position");
  if (glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) < 1e-6) {
    refuse("camera.up", "must not be parallel to the view; to look straight down, set it to 0 0 -1");
  }
  if (camera.projection == Camera::Projection::kPerspective) {
    if (!(camera.fov_degrees >= 0.001 && camera.fov_degrees <= 179)) {
      refuse("camera.fov_degrees", fmt::format("expected an angle from 0.001 to 179, not {}", camera.fov_degrees));
    }
  } else if (!(camera.height > 0 && camera.height <= kFarthest)) {
    refuse("camera.height", fmt::format("expected a number above 0, at most {}, not {}", kFarthest, camera.height));
  }
}

}  // namespace

void check(const RenderScene& scene) {
  check_camera(scene.camera);
  check_direction("sun.direction", scene.sun.direction);
  check_color("sun.color", scene.sun.color, kBrightest);
  check_range("sun.intensity", scene.sun.intensity, 0, kBrightest);
  check_range("sun.angle_degrees", scene.sun.angle_degrees, 0, 180);
  check_color("sky.zenith", scene.sky.zenith, kBrightest);
  check_color("sky.horizon", scene.sky.horizon, kBrightest);
  check_range("sky.intensity", scene.sky.intensity, 0, kBrightest);
  check_range("ground.height", scene.ground.height, -kFarthest, kFarthest);
  check_color("ground.color", scene.ground.color, 1);
  check_color("material.color", scene.material.color, 1);
  check_range("material.specular", scene.material.specular, 0, 1);
  if (!(scene.material.roughness > 0 && scene.material.roughness <= 1)) {
    refuse("material.roughness", fmt::format("expected a number above 0, at most 1, not {}", scene.material.roughness));
  }
}

void check(const RenderOptions& options) {
  const auto side = [](int length) { return length >= 1 && length <= kLongestSide; };
  const std::string size = fmt::format("{}x{}", options.width, options.height);
  if (!side(options.width) || !side(options.height)) {
    refuse("size", fmt::format("expected sides from 1 to {}, not {}", kLongestSide, size));
  }
  if (options.bounces < 0 || options.bounces > 1) {
    refuse("bounces", fmt::format("expected 0 or 1, not {}", options.bounces));
  }
  if (options.samples_per_pixel < 1 || options.samples_per_pixel > kMostSamples) {
    refuse("spp", fmt::format("expected a number from 1 to {}, not {}", kMostSamples, options.samples_per_pixel));
  }
  const PixelRegion& r = options.region;
  const bool whole = r.width == 0 && r.height == 0 && r.x == 0 && r.y == 0;
  if (!whole && (r.x < 0 || r.y < 0 || r.width < 1 || r.height < 1 || r.width > options.width - r.x ||
                 r.height > options.height - r.y)) {
    refuse("region", fmt::format("{}x{}+{}+{} is not a part of the picture's {}", r.width, r.height, r.x, r.y, size));
  }
  const std::int64_t pixels = whole ? std::int64_t{options.width} * options.height : std::int64_t{r.width} * r.height;
  if (pixels > kMostPixels) {
    throw LimitError(fmt::format("size: {} is more than {} pixels; render it in regions", size, kMostPixels));
  }
}

}  // namespace barkridge
