#include "raytrace/image_texture.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "base/error.h"
#include "raytrace/image_file.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// An image whose left half has one colour and right half another, on its upper half; the lower half is black.
Image halves(const Color& left, const Color& right) {
  Image image{64, 64, {0, 0, 64, 64}, {}};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Color color = y >= 32 ? Color(0) : x < 32 ? left : right;
      for (int c = 0; c < 3; ++c) image.rgba.push_back(static_cast<float>(color[c]));
      image.rgba.push_back(1);
    }
  }
  return image;
}

}  // namespace

TEST_CASE("a texture has its image's linear colours, v up, and repeats") {
  const ScratchFolder folder;
  const Color left(0.5, 0.25, 0.125), right(0.125, 0.75, 0.5);
  for (const std::string name : {"a.exr", "a.png"}) {
    write_image(halves(left, right), folder.path(name));
    const auto texture = open_texture(folder.path(name));
    for (const double lap : {-3.0, 0.0, 1.0}) {
      const glm::dvec2 footprint(1e-3);
      CHECK(glm::distance(texture->color({0.25 + lap, 0.75 - lap}, footprint), left) < 5e-3);
      CHECK(glm::distance(texture->color({0.75 + lap, 0.75 + lap}, footprint), right) < 5e-3);
      CHECK(glm::length(texture->color({0.25 + lap, 0.25 + lap}, footprint)) < 5e-3);
    }
  }
}

TEST_CASE("over a wide footprint a texture is its mean") {
  const ScratchFolder folder;
  write_image(halves(Color(0.8), Color(0.4)), folder.path("a.exr"));
  const auto texture = open_texture(folder.path("a.exr"));
  for (const double u : {0.1, 0.4, 0.9}) {
    CHECK(texture->color({u, 0.3}, glm::dvec2(2)).y == Approx(0.3).margin(0.02));
  }
}

TEST_CASE("what is no image is refused by name") {
  const ScratchFolder folder;
  std::ofstream(folder.path("a.png")) << "no image";
  CHECK_THROWS_WITH(open_texture(folder.path("a.png")),
                    Catch::Contains("a.png") && Catch::Contains("expected an image"));
  CHECK_THROWS_AS(open_texture(folder.path("missing.exr")), InputError);
}
