#include "raytrace/surface_layers.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include "raytrace/image_file.h"
#include "tests/raytrace/test_fields.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

class TwiceX final : public SurfaceLayers {
 public:
  std::vector<std::string> names() const override { return {"twice"}; }
  void values(const Vec3& point, std::span<float> values) const override {
    values[0] = static_cast<float>(2 * point.x);
  }
};

// Red on the right of the plane x = 0, and bumped to face the viewer everywhere.
class RedRight final : public SurfaceShader {
 public:
  ShadedPoint shade(const Vec3& point, const Vec3&, double footprint) const override {
    CHECK(footprint > 0);
    return {{point.x > 0 ? Color(1, 0, 0) : Color(0, 1, 0), 0, 1}, {0, 0, 1}};
  }
};

RenderScene scene_before(double height) {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.camera.projection = Camera::Projection::kOrthographic;
  scene.camera.position = {0, 0, 9};
  scene.camera.height = height;
  return scene;
}

RenderOptions picture(int size) {
  RenderOptions options;
  options.width = options.height = size;
  options.samples_per_pixel = 4;
  return options;
}

}  // namespace

TEST_CASE("layers hold the solid's points, normals and the scene's own, and 0 beside it") {
  RenderScene scene = scene_before(4);
  scene.layers = std::make_shared<TwiceX>();
  const FieldPtr field = ball({0, 0, 0}, 1);
  const Image image = render(*field, scene, picture(40));
  REQUIRE(image.layer_names == std::vector<std::string>{"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "twice"});
  REQUIRE(image.layers.size() == 7 * 40 * 40);
  int on_ball = 0;
  for (std::size_t i = 0; i < 40 * 40; ++i) {
    const float* at = &image.layers[7 * i];
    const Vec3 point(at[0], at[1], at[2]), normal(at[3], at[4], at[5]);
    const double x = (static_cast<double>(i % 40) + 0.5) / 10 - 2, y = 2 - (static_cast<double>(i / 40) + 0.5) / 10;
    if (std::hypot(x, y) > 1) {
      CHECK((point == Vec3(0) && normal == Vec3(0) && at[6] == 0));
      continue;
    }
    ++on_ball;
    CHECK(glm::distance(point, Vec3(x, y, std::sqrt(1 - x * x - y * y))) < 1e-4);
    CHECK(glm::distance(normal, point) < 1e-4);
    CHECK(at[6] == Approx(2 * x).margin(1e-5));
  }
  CHECK(on_ball > 300);

  const ScratchFolder folder;
  write_image(image, folder.path("a.exr"));
  const auto input = OIIO::ImageInput::open(folder.path("a.exr"));
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  REQUIRE(spec.nchannels == 11);
  std::vector<float> pixels(11 * 40 * 40);
  REQUIRE(input->read_image(0, 0, 0, 11, OIIO::TypeDesc::FLOAT, pixels.data()));
  for (std::size_t c = 0; c < 7; ++c) {
    const auto channel = static_cast<std::size_t>(spec.channelindex(image.layer_names[c]));
    for (std::size_t i = 0; i < 40 * 40; ++i) REQUIRE(pixels[11 * i + channel] == image.layers[7 * i + c]);
  }
  CHECK(spec.channelindex("A") >= 0);
}

TEST_CASE("layers leave the picture as it is, and a region's are those of the whole") {
  RenderScene scene = scene_before(4);
  const FieldPtr field = ball({0, 0, 0}, 1);
  const Image plain = render(*field, scene, picture(32));
  CHECK(plain.layers.empty());
  scene.layers = std::make_shared<TwiceX>();
  RenderOptions options = picture(32);
  const Image whole = render(*field, scene, options);
  CHECK(whole.rgba == plain.rgba);
  options.region = {8, 12, 10, 5};
  const Image part = render(*field, scene, options);
  for (std::size_t y = 0; y < 5; ++y) {
    for (std::size_t i = 0; i < 7 * 10; ++i) {
      REQUIRE(part.layers[7 * 10 * y + i] == whole.layers[7 * (32 * (12 + y) + 8) + i]);
    }
  }
}

TEST_CASE("a shader's colours and normals are those of the solid") {
  RenderScene scene = scene_before(1);
  scene.sky.intensity = 0;
  scene.sun = {{0, 0, 1}, Color(1), 1, 0};
  scene.shader = std::make_shared<RedRight>();
  const Image image = render(*ball({0, 0, 0}, 1), scene, picture(16));
  // Lambert surfaces that face sun and viewer, bumped flat: but for what scattered light adds, of which there is none.
  for (std::size_t i = 0; i < 16 * 16; ++i) {
    const std::size_t column = i % 16;
    if (column == 7 || column == 8) continue;
    CHECK(image.rgba[4 * i] == Approx(column > 8 ? 1 : 0).margin(1e-4));
    CHECK(image.rgba[4 * i + 1] == Approx(column > 8 ? 0 : 1).margin(1e-4));
  }
}
