#include "raytrace/render.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "raytrace/light.h"
#include "tests/raytrace/test_fields.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// Nothing but what a test adds: no light, no ground, no lobe.
RenderScene bare_scene() {
  RenderScene scene;
  scene.sun.intensity = 0;
  scene.sun.angle_degrees = 0;
  scene.sky.intensity = 0;
  scene.ground.enabled = false;
  scene.material = {Color(0.5), 0, 1};
  return scene;
}

Camera orthographic(const Vec3& position, const Vec3& target, double height) {
  Camera camera;
  camera.projection = Camera::Projection::kOrthographic;
  camera.position = position;
  camera.target = target;
  camera.height = height;
  return camera;
}

RenderOptions picture(int width, int height, int samples) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples_per_pixel = samples;
  return options;
}

// What a tiny orthographic camera sees that looks at a point from a direction: green, since most tests are grey.
double radiance_at(const Field& field, RenderScene scene, const Vec3& point, const Vec3& from, int samples) {
  scene.camera = orthographic(point + from, point, 1e-4);
  return render(field, scene, picture(1, 1, samples)).rgba[1];
}

double sum_of_alpha(const Image& image) {
  double sum = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  return sum;
}

// A bit of everything, for tests of invariance.
FieldPtr still_life() {
  return sum({ball({-0.5, 0.5, 0}, 0.5), ball({0.5, 0.4, 0.3}, 0.4), torus({0.2, 0.2, 0.9}, 0.4, 0.1)});
}

RenderScene still_life_scene() {
  RenderScene scene;
  scene.camera.position = {1, 2, 5};
  scene.camera.target = {0, 0.4, 0};
  return scene;
}

}  // namespace

TEST_CASE("a ball's silhouette has its area, in both projections") {
  RenderScene scene = bare_scene();
  scene.camera = orthographic({0, 0, 5}, {0, 0, 0}, 3);
  const Image flat = render(*ball({0, 0, 0}, 1), scene, picture(160, 120, 16));
  CHECK(sum_of_alpha(flat) * (3.0 / 120) * (3.0 / 120) == Approx(M_PI).epsilon(1e-3));

  scene.camera = {};
  scene.camera.position = {3, 4, 12};
  scene.camera.target = {0, 0, 0};
  scene.camera.fov_degrees = 15;
  const Image deep = render(*ball({0, 0, 0}, 1), scene, picture(120, 160, 16));
  const double pixel = 2 * std::tan(7.5 * M_PI / 180) / 160;
  // The cone of tangents from distance 13 meets the plane at distance 1 in a circle of radius 1 / sqrt(13^2 - 1).
  CHECK(sum_of_alpha(deep) * pixel * pixel == Approx(M_PI / 168).epsilon(1e-3));
}

TEST_CASE("right is right and up is up") {
  RenderScene scene = bare_scene();
  const auto place = [&](const Vec3& center) {
    const Image image = render(*ball(center, 0.3), scene, picture(20, 20, 4));
    double x = 0, y = 0;
    for (int i = 0; i < 400; ++i) {
      x += image.rgba[static_cast<std::size_t>(4 * i + 3)] * (i % 20 - 9.5);
      y += image.rgba[static_cast<std::size_t>(4 * i + 3)] * (i / 20 - 9.5);
    }
    return glm::dvec2(x, y);
  };
  for (const auto projection : {Camera::Projection::kPerspective, Camera::Projection::kOrthographic}) {
    scene.camera.projection = projection;
    CHECK(place({0.5, 0, 0}).x > 1);
    CHECK(place({0, 0.5, 0}).y < -1);
    CHECK(std::abs(place({0, 0.5, 0}).x) < 1);
  }
}

TEST_CASE("a Lambert ball in the sun is as bright as its slope, without specks, at every scale") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    RenderScene scene = bare_scene();
    scene.sun.intensity = 2;
    scene.sun.color = Color(1);
    scene.sun.direction = {1, 1, 1};
    scene.camera = orthographic(scale * Vec3(0, 0, 5), {0, 0, 0}, 2 * scale);
    const int size = 64;
    const Image image = render(*ball({0, 0, 0}, scale), scene, picture(size, size, 16));
    const Vec3 light = glm::normalize(scene.sun.direction);
    int compared = 0, wrong = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const double u = (2 * x + 1.0) / size - 1, v = 1 - (2 * y + 1.0) / size;
        if (u * u + v * v > 0.8) continue;
        const double cosine = glm::dot(Vec3(u, v, std::sqrt(1 - u * u - v * v)), light);
        const double seen = image.rgba[4 * static_cast<std::size_t>(y * size + x) + 1];
        ++compared;
        if (std::abs(cosine) < 0.08) continue;  // the pixel's filter reaches across the terminator
        if (std::abs(seen - 0.5 * 2 * std::max(0.0, cosine)) > 0.01) ++wrong;
      }
    }
    CHECK(compared > 2000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("in a uniform sky a white ball cannot be seen") {
  RenderScene scene = bare_scene();
  scene.sky = {Color(0.7), Color(0.7), 1};
  scene.material.color = Color(1);
  const Image image = render(*ball({0, 0, 0}, 1), scene, picture(32, 32, 9));
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    REQUIRE(std::abs(image.rgba[i] - (i % 4 == 3 ? 1.0f : 0.7f)) < 1e-6f);
  }
}

TEST_CASE("a black ball takes its share of the sky from the ground below") {
  RenderScene scene = bare_scene();
  scene.sky = {Color(0.8), Color(0.8), 1};
  scene.ground.enabled = true;
  scene.ground.color = Color(0.5);
  scene.material.color = Color(0);
  // A ball of radius r whose center is at height d covers r^2 / d^2 of the cosine-weighted hemisphere below it.
  for (const double d : {1.25, 3.0}) {
    const double expected = 0.5 * 0.8 * (1 - 1 / (d * d));
    CHECK(radiance_at(*ball({0, d, 0}, 1), scene, {0, 0, 0}, {1, 0.05, 0}, 16384) == Approx(expected).epsilon(0.01));
  }
  CHECK(radiance_at(*sum({}), scene, {0, 0, 0}, {1, 1, 0}, 16) == Approx(0.5 * 0.8).epsilon(1e-4));
}

TEST_CASE("a ball's shadow lies where the sun throws it") {
  RenderScene scene = bare_scene();
  scene.ground.enabled = true;
  scene.ground.color = Color(0.5);
  scene.sun.intensity = 1;
  scene.sun.direction = {3, 4, 0};
  const FieldPtr field = ball({0, 2, 0}, 0.5);
  // The shadow's center is at x = -2 * 3/4; its half axes are 0.5 * 5/4 along x and 0.5 along z.
  const auto lit = [&](double x, double z) { return radiance_at(*field, scene, {x, 0, z}, {0.1, 0.2, 1}, 1) > 0.1; };
  CHECK_FALSE(lit(-1.5, 0));
  for (const double sign : {-1.0, 1.0}) {
    CHECK_FALSE(lit(-1.5 + sign * 0.624, 0));
    CHECK(lit(-1.5 + sign * 0.626, 0));
    CHECK_FALSE(lit(-1.5, sign * 0.499));
    CHECK(lit(-1.5, sign * 0.501));
  }
  scene.sun.direction.y = -4;
  CHECK_FALSE(lit(-5, 0));
}

TEST_CASE("a wide sun behind a ball still lights by what it shows") {
  RenderScene scene = bare_scene();
  scene.ground.enabled = true;
  scene.ground.color = Color(1);
  scene.sun.color = Color(1);
  scene.sun.intensity = 1;
  scene.sun.direction = {0, 1, 0};
  scene.sun.angle_degrees = 40;
  // The ball covers the middle of the sun's disc up to asin(0.5 / 2).
  const double sun_sine = std::sin(20 * M_PI / 180), ball_sine = 0.25;
  const double expected = (sun_sine * sun_sine - ball_sine * ball_sine) / (2 * (1 - std::cos(20 * M_PI / 180)));
  CHECK(radiance_at(*ball({0, 2, 0}, 0.5), scene, {0, 0, 0}, {1, 0.3, 0}, 16384) == Approx(expected).epsilon(0.01));
}

TEST_CASE("the sky's average is the light of a white floor") {
  const Sky sky{{0.1, 0.2, 0.9}, {0.8, 0.7, 0.6}, 1.5};
  Color sum(0);
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double y = (i + 0.5) / steps;
    sum += 2 * y / steps * sky_radiance(sky, {std::sqrt(1 - y * y), y, 0});
  }
  CHECK(glm::length(sum - sky_average(sky)) < 1e-6);
}

TEST_CASE("alpha is full under a sky, and marks the solid without one") {
  RenderScene scene = still_life_scene();
  const RenderOptions options = picture(48, 32, 4);
  CHECK(sum_of_alpha(render(*still_life(), scene, options)) == Approx(48 * 32));
  scene.sky.intensity = 0;
  scene.ground.enabled = false;
  const Image image = render(*still_life(), scene, options);
  CHECK(image.rgba[3] == 0);
  CHECK(sum_of_alpha(image) > 100);
  CHECK(sum_of_alpha(image) < 48 * 32 - 100);
}

TEST_CASE("a region holds the same bits as the whole picture") {
  const RenderScene scene = still_life_scene();
  RenderOptions options = picture(80, 60, 9);
  const Image whole = render(*still_life(), scene, options);
  for (const PixelRegion region : {PixelRegion{17, 5, 41, 38}, PixelRegion{79, 59, 1, 1}, PixelRegion{0, 31, 80, 2}}) {
    options.region = region;
    const Image part = render(*still_life(), scene, options);
    REQUIRE(part.full_width == 80);
    int different = 0;
    for (int y = 0; y < region.height; ++y) {
      for (int x = 0; x < region.width; ++x) {
        for (int c = 0; c < 4; ++c) {
          const int a = 4 * (y * region.width + x) + c, b = 4 * ((y + region.y) * 80 + x + region.x) + c;
          different += part.rgba[static_cast<std::size_t>(a)] != whole.rgba[static_cast<std::size_t>(b)];
        }
      }
    }
    CHECK(different == 0);
  }
}

TEST_CASE("threads change nothing, the seed only the noise") {
  const RenderScene scene = still_life_scene();
  RenderOptions options = picture(100, 70, 9);
  const Image image = render(*still_life(), scene, options);
  {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(render(*still_life(), scene, options).rgba == image.rgba);
  }
  options.seed = 1;
  const Image other = render(*still_life(), scene, options);
  double difference = 0, mean_difference = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    difference += std::abs(image.rgba[i] - other.rgba[i]);
    mean_difference += image.rgba[i] - other.rgba[i];
  }
  const double count = static_cast<double>(image.rgba.size());
  CHECK(difference / count > 1e-4);
  CHECK(difference / count < 0.02);
  CHECK(std::abs(mean_difference / count) < 5e-4);
}

TEST_CASE("more samples go where they are needed") {
  // The upright edge of a ball, seen so close that it is nearly straight.
  RenderScene scene = bare_scene();
  scene.camera = orthographic({1, 0, 5}, {1, 0, 0}, 0.02);
  const FieldPtr field = ball({0, 0, 0}, 1);
  double worst = 0;
  const Image image = render(*field, scene, picture(20, 20, 256));
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      // The tent filter's share of what lies left of the edge, which is x = 1 but for the ball's curvature. A
      // pixel is 0.001 wide.
      const double edge = 10 - (x + 0.5) - 0.5 * std::pow((y - 9.5) * 0.001, 2) / 0.001;
      const double e = std::clamp(edge, -1.0, 1.0);
      const double share = e < 0 ? 0.5 * (1 + e) * (1 + e) : 1 - 0.5 * (1 - e) * (1 - e);
      worst = std::max(worst, std::abs(share - image.rgba[4 * static_cast<std::size_t>(20 * y + x) + 3]));
    }
  }
  CHECK(worst < 1.0 / 64);
}

TEST_CASE("progress grows to one, and can stop the work") {
  RenderOptions options = picture(100, 70, 1);
  double last = 0;
  options.progress = [&](double fraction) {
    CHECK(fraction >= last);
    last = fraction;
    return true;
  };
  render(*still_life(), still_life_scene(), options);
  CHECK(last == 1);
  options.progress = [](double fraction) { return fraction < 0.3; };
  CHECK_THROWS_AS(render(*still_life(), still_life_scene(), options), Cancelled);
  options.progress = [](double) { return false; };
  CHECK_THROWS_AS(render(*still_life(), still_life_scene(), options), Cancelled);
}
