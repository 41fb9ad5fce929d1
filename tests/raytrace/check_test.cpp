#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <string>

#include "raytrace/render.h"

using namespace barkridge;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string complaint(const std::function<void(RenderScene&)>& spoil) {
  RenderScene scene;
  check(scene);
  spoil(scene);
  try {
    check(scene);
  } catch (const InputError& error) {
    return error.message().substr(0, error.message().find(':'));
  }
  return "accepted";
}

std::string complaint_about(const std::function<void(RenderOptions&)>& spoil) {
  RenderOptions options;
  check(options);
  spoil(options);
  try {
    check(options);
  } catch (const InputError& error) {
    return error.message().substr(0, error.message().find(':'));
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a scene's bad settings are named") {
  using S = RenderScene;
  CHECK(complaint([](S& s) { s.camera.position.x = kNan; }) == "camera.position");
  CHECK(complaint([](S& s) { s.camera.target = s.camera.position; }) == "camera.target");
  CHECK(complaint([](S& s) { s.camera.target.z = kInfinity; }) == "camera.target");
  CHECK(complaint([](S& s) { s.camera.up = Vec3(0); }) == "camera.up");
  CHECK(complaint([](S& s) { s.camera.position = {0, 5, 0}; }) == "camera.up");
  CHECK(complaint([](S& s) { s.camera.fov_degrees = 180; }) == "camera.fov_degrees");
  CHECK(complaint([](S& s) { s.camera.fov_degrees = 0; }) == "camera.fov_degrees");
  CHECK(complaint([](S& s) {
          s.camera.projection = Camera::Projection::kOrthographic;
          s.camera.height = 0;
        }) == "camera.height");
  CHECK(complaint([](S& s) { s.sun.direction = Vec3(0); }) == "sun.direction");
  CHECK(complaint([](S& s) { s.sun.intensity = -1; }) == "sun.intensity");
  CHECK(complaint([](S& s) { s.sun.color.y = kNan; }) == "sun.color");
  CHECK(complaint([](S& s) { s.sun.angle_degrees = 181; }) == "sun.angle_degrees");
  CHECK(complaint([](S& s) { s.sky.zenith.x = -0.1; }) == "sky.zenith");
  CHECK(complaint([](S& s) { s.sky.horizon.x = kInfinity; }) == "sky.horizon");
  CHECK(complaint([](S& s) { s.sky.intensity = kNan; }) == "sky.intensity");
  CHECK(complaint([](S& s) { s.ground.height = kInfinity; }) == "ground.height");
  CHECK(complaint([](S& s) { s.ground.color.x = 1.5; }) == "ground.color");
  CHECK(complaint([](S& s) { s.material.color.z = -1; }) == "material.color");
  CHECK(complaint([](S& s) { s.material.specular = 1.01; }) == "material.specular");
  CHECK(complaint([](S& s) { s.material.roughness = 0; }) == "material.roughness");
}

TEST_CASE("a picture's bad settings are named") {
  using O = RenderOptions;
  CHECK(complaint_about([](O& o) { o.width = 0; }) == "size");
  CHECK(complaint_about([](O& o) { o.height = 65537; }) == "size");
  CHECK(complaint_about([](O& o) { o.width = o.height = 65536; }) == "size");
  CHECK(complaint_about([](O& o) { o.samples_per_pixel = 0; }) == "spp");
  CHECK(complaint_about([](O& o) { o.bounces = 2; }) == "bounces");
  CHECK(complaint_about([](O& o) { o.samples_per_pixel = 65537; }) == "spp");
  CHECK(complaint_about([](O& o) { o.region = {700, 0, 69, 1}; }) == "region");
  CHECK(complaint_about([](O& o) { o.region = {-1, 0, 5, 5}; }) == "region");
  CHECK(complaint_about([](O& o) { o.region = {0, 0, 5, 0}; }) == "region");
  CHECK(complaint_about([](O& o) { o.region = {1, 0, 2147483647, 5}; }) == "region");
  CHECK(complaint_about([](O& o) {
          o.width = o.height = 65536;
          o.region = {65535, 65535, 1, 1};
        }) == "accepted");
}
