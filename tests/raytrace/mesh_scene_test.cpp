// Rays against meshes of known solids.

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "raytrace/render.h"
#include "raytrace/tracer.h"

using namespace barkridge;

namespace {

// A ball of meridians and parallels, with its true normals.
Mesh ball_mesh(const Vec3& center, double radius, std::uint32_t around, std::uint32_t along) {
  Mesh mesh;
  const auto add = [&](const Vec3& normal) {
    mesh.normals.emplace_back(normal);
    mesh.positions.emplace_back(center + radius * normal);
  };
  add({0, 1, 0});
  for (std::uint32_t j = 1; j < along; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double theta = M_PI * j / along, phi = 2 * M_PI * i / around;
      add({std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)});
    }
  }
  add({0, -1, 0});
  const auto ring = [&](std::uint32_t j, std::uint32_t i) { return 1 + (j - 1) * around + i % around; };
  const std::uint32_t last = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
  for (std::uint32_t i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, ring(1, i), ring(1, i + 1)});
    mesh.triangles.push_back({last, ring(along - 1, i + 1), ring(along - 1, i)});
    for (std::uint32_t j = 1; j + 1 < along; ++j) {
      mesh.triangles.push_back({ring(j, i), ring(j + 1, i), ring(j + 1, i + 1)});
      mesh.triangles.push_back({ring(j, i), ring(j + 1, i + 1), ring(j, i + 1)});
    }
  }
  return mesh;
}

Vec3 random_direction(std::uint64_t i) {
  const double z = 2 * random_unit(3, i, 1) - 1, angle = 2 * M_PI * random_unit(3, i, 2);
  return {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
}

}  // namespace

TEST_CASE("rays meet a fine mesh of a ball where they meet the ball") {
  const Vec3 center(0.3, -2, 5);
  const double radius = 1.5;
  const std::uint32_t around = 400;
  const Tracer tracer(ball_mesh(center, radius, around, 200));
  // The triangles lie inside the ball by at most the sagitta of their longest edge, a diagonal.
  const double sagitta = radius * std::pow(std::sqrt(2.0) * M_PI / around, 2) / 2 * 1.01;
  int grazing = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Vec3 direction = random_direction(i);
    Vec3 u, v;
    complete_frame(direction, u, v);
    const double reach = 1.2 * radius * std::sqrt(random_unit(3, i, 4)), angle = 2 * M_PI * random_unit(3, i, 5);
    const Ray ray{center + reach * (std::cos(angle) * u + std::sin(angle) * v) - 7.0 * direction, direction};
    const std::optional<Hit> hit = tracer.first_hit(ray);
    CHECK(tracer.occluded(ray) == hit.has_value());
    if (std::abs(reach - radius) <= 2 * sagitta) {
      ++grazing;
      continue;
    }
    REQUIRE(hit.has_value() == (reach < radius));
    if (!hit) continue;
    CHECK(glm::length(hit->point - ray.at(hit->t)) < 1e-5);
    const double distance = glm::length(hit->point - center);
    CHECK(distance <= radius + 1e-6);
    CHECK(distance >= radius - sagitta - 1e-6);
    CHECK(glm::length(hit->normal - (hit->point - center) / distance) < 1e-4);
    CHECK(glm::dot(hit->outward, hit->normal) > 0.99);
    // Light from outside reaches the point that secondary rays leave from.
    CHECK_FALSE(tracer.occluded({hit->outside_point(), hit->outward}));
    CHECK(tracer.occluded({hit->outside_point(), -hit->outward}));
  }
  CHECK(grazing < 100);
}

TEST_CASE("no ray passes between the triangles of a closed mesh") {
  const Mesh mesh = ball_mesh({0, 0, 0}, 1, 16, 8);
  const Tracer tracer(mesh);
  int through = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    // From the middle through a random point of an edge.
    const auto& triangle = mesh.triangles[i % mesh.triangles.size()];
    const double share = random_unit(5, i, 0);
    const Vec3 target = (1 - share) * Vec3(mesh.positions[triangle[0]]) + share * Vec3(mesh.positions[triangle[1]]);
    if (!tracer.occluded({Vec3(0), glm::normalize(target)})) ++through;
  }
  CHECK(through == 0);
}

TEST_CASE("an open mesh is met from both sides, with the normal of the side it is met from") {
  Mesh sheet;
  sheet.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
  sheet.normals.assign(4, {0, 1, 0});
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Tracer tracer(sheet);
  for (const double side : {1.0, -1.0}) {
    const auto hit = tracer.first_hit({{0.2, 3 * side, 0.1}, {0, -side, 0}});
    REQUIRE(hit);
    CHECK(hit->t == Approx(3));
    CHECK(hit->normal.y == Approx(side));
    CHECK(hit->outward.y == Approx(side));
  }
}

TEST_CASE("nothing is met where a mesh has no triangle") {
  CHECK_FALSE(Tracer(Mesh{}).first_hit({{0, 0, 5}, {0, 0, -1}}));
  CHECK_FALSE(Tracer(Mesh{}).occluded({{0, 0, 5}, {0, 0, -1}}));
}

TEST_CASE("a ball's mesh has the colours of a lit ball") {
  RenderScene scene;
  scene.camera = {Camera::Projection::kOrthographic, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 35, 2.5};
  scene.sun = {{1, 0, 1}, Color(1), 1, 0};
  scene.sky.intensity = 0;
  scene.ground.enabled = false;
  scene.material = {Color(0.8), 0, 1};
  RenderOptions options;
  options.width = options.height = 100;
  options.samples_per_pixel = 1;
  options.bounces = 0;
  const Image image = render(ball_mesh({0, 0, 0}, 1, 256, 128), scene, options);
  int lit = 0, wrong = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const double px = (x + 0.5 - 50) / 40, py = (50 - y - 0.5) / 40, r2 = px * px + py * py;
      const float* pixel = &image.rgba[4 * static_cast<std::size_t>(y * 100 + x)];
      if (r2 > 1.1) CHECK(pixel[3] == 0.0F);
      if (r2 > 0.9) continue;
      const double cosine = (px + std::sqrt(1 - r2)) / std::sqrt(2.0);
      if (cosine < 0.15) continue;
      ++lit;
      // A sample lies up to a pixel beside its pixel's middle.
      if (std::abs(static_cast<double>(pixel[0]) - 0.8 * cosine) > 0.06) ++wrong;
    }
  }
  CHECK(lit > 2500);
  CHECK(wrong == 0);
}
