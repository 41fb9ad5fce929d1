#include "raytrace/image_file.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>
#include <memory>

#include "base/output_file.h"
#include "base/random.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

Image noise(int full_width, int full_height, const PixelRegion& region) {
  Image image{full_width, full_height, region, {}};
  image.rgba.resize(4 * static_cast<std::size_t>(region.width * region.height));
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = i % 4 == 3 ? 1.0f : static_cast<float>(random_unit(i));
  }
  return image;
}

const ImageMetadata kMetadata{
    {"barkridge/version", "1.2.3"}, {"barkridge/scene_sha256", "abc"}, {"barkridge/seed", "7"}};

}  // namespace

TEST_CASE("an EXR holds linear half RGBA with its region and metadata") {
  const ScratchFolder folder;
  const Image image = noise(60, 40, {10, 20, 33, 17});
  write_image(image, folder.path("a.EXR"), kMetadata);
  const auto input = OIIO::ImageInput::open(folder.path("a.EXR"));
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  CHECK(spec.format == OIIO::TypeDesc::HALF);
  CHECK(spec.channelnames == std::vector<std::string>{"R", "G", "B", "A"});
  CHECK((spec.x == 10 && spec.y == 20 && spec.width == 33 && spec.height == 17));
  CHECK((spec.full_width == 60 && spec.full_height == 40 && spec.full_x == 0 && spec.full_y == 0));
  CHECK(spec.get_string_attribute("barkridge/version") == "1.2.3");
  CHECK(spec.get_string_attribute("barkridge/scene_sha256") == "abc");
  CHECK(spec.get_string_attribute("compression") == "zip");
  CHECK(spec.find_attribute("chromaticities") != nullptr);
  std::vector<float> pixels(image.rgba.size());
  REQUIRE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, pixels.data()));
  for (std::size_t i = 0; i < pixels.size(); ++i) REQUIRE(std::abs(pixels[i] - image.rgba[i]) <= 5e-4f * image.rgba[i]);
}

TEST_CASE("a PNG holds 8-bit sRGB with straight alpha and metadata") {
  const ScratchFolder folder;
  // Linear grey of 0.21586 is 128 in sRGB. The third pixel is half transparent, the fourth wholly.
  Image image{2, 2, {0, 0, 2, 2}, {0, 1, 0.2158605f, 1, 7, -1, 0.0020f, 1, 0.10793f, 0, 0.5f, 0.5f, 0, 0, 0, 0}};
  write_image(image, folder.path("a.png"), kMetadata);
  const auto input = OIIO::ImageInput::open(folder.path("a.png"));
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  CHECK(spec.format == OIIO::TypeDesc::UINT8);
  CHECK(spec.nchannels == 4);
  CHECK(spec.get_string_attribute("oiio:ColorSpace") == "sRGB");
  CHECK(spec.get_string_attribute("barkridge/version") == "1.2.3");
  CHECK(spec.get_string_attribute("barkridge/seed") == "7");
  const OIIO::ImageSpec keep = [] {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
  }();
  const auto raw = OIIO::ImageInput::open(folder.path("a.png"), &keep);
  std::vector<std::uint8_t> pixels(16);
  REQUIRE(raw->read_image(0, 0, 0, 4, OIIO::TypeDesc::UINT8, pixels.data()));
  CHECK(pixels == std::vector<std::uint8_t>{0, 255, 128, 255, 255, 0, 7, 255, 128, 0, 255, 128, 0, 0, 0, 0});
}

TEST_CASE("equal pictures give equal bytes, at any time") {
  const ScratchFolder folder;
  const Image image = noise(64, 48, {0, 0, 64, 48});
  for (const std::string name : {"a.exr", "a.png"}) write_image(image, folder.path(name), kMetadata);
  ::sleep(1);  // a time stamp would show
  for (const std::string name : {"b.exr", "b.png"}) write_image(image, folder.path(name), kMetadata);
  CHECK(read_file(folder.path("a.exr")) == read_file(folder.path("b.exr")));
  CHECK(read_file(folder.path("a.png")) == read_file(folder.path("b.png")));
}

TEST_CASE("a full disk is an error that leaves the old picture") {
  const ScratchFolder folder;
  for (const std::string extension : {".exr", ".png"}) {
    const std::string path = folder.path("a" + extension);
    write_image(noise(8, 8, {0, 0, 8, 8}), path);
    const std::string old = read_file(path);
    {
      const FileSizeLimit limit(1 << 16);
      CHECK_THROWS_AS(write_image(noise(512, 512, {0, 0, 512, 512}), path), IoError);
    }
    CHECK(read_file(path) == old);
  }
  CHECK(folder.entries() == 2);
}

TEST_CASE("unknown formats and unwritable places are refused") {
  CHECK_THROWS_AS(check_image_path("a.jpg"), InputError);
  CHECK_THROWS_AS(check_image_path("png"), InputError);
  CHECK_THROWS_WITH(check_image_path("a.tif"), Catch::Contains(".exr") && Catch::Contains(".png"));
  CHECK_NOTHROW(check_image_path("dir.x/a.PNG"));
  CHECK_THROWS_AS(write_image(noise(2, 2, {0, 0, 2, 2}), "/nowhere/at/all.png"), IoError);
}
