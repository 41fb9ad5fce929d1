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

// The four channels of a PNG as they are in the file.
std::vector<std::uint8_t> straight_bytes(const std::string& path) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path, &config);
  REQUIRE(input);
  std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(input->spec().width * input->spec().height));
  REQUIRE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::UINT8, bytes.data()));
  return bytes;
}

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
  for (const auto& [name, text] : kMetadata) CHECK(spec.get_string_attribute(name) == text);
  CHECK(straight_bytes(folder.path("a.png")) ==
        std::vector<std::uint8_t>{0, 255, 128, 255, 255, 0, 7, 255, 128, 0, 255, 128, 0, 0, 0, 0});
}

TEST_CASE("a PNG of a region knows its place") {
  const ScratchFolder folder;
  for (const PixelRegion& region : {PixelRegion{10, 20, 33, 17}, {0, 20, 33, 17}, {10, 0, 33, 17}, {0, 0, 60, 40}}) {
    write_image(noise(60, 40, region), folder.path("a.png"));
    const auto input = OIIO::ImageInput::open(folder.path("a.png"));
    REQUIRE(input);
    const OIIO::ImageSpec& spec = input->spec();
    CHECK((spec.x == region.x && spec.y == region.y && spec.width == region.width && spec.height == region.height));
  }
}

TEST_CASE("a PNG keeps every byte of alpha") {
  const ScratchFolder folder;
  Image image{256, 1, {0, 0, 256, 1}, {}};
  for (int i = 0; i < 256; ++i) {
    const float alpha = static_cast<float>(i) / 255;
    image.rgba.insert(image.rgba.end(), {alpha, alpha, 0, alpha});  // straight yellow
  }
  write_image(image, folder.path("a.png"));
  const std::vector<std::uint8_t> pixels = straight_bytes(folder.path("a.png"));
  for (int i = 0; i < 256; ++i) {
    const std::uint8_t yellow = i > 0 ? 255 : 0;
    REQUIRE(std::vector<std::uint8_t>(pixels.begin() + 4 * i, pixels.begin() + 4 * (i + 1)) ==
            std::vector<std::uint8_t>{yellow, yellow, 0, static_cast<std::uint8_t>(i)});
  }
}

TEST_CASE("metadata may be UTF-8, and long") {
  const ScratchFolder folder;
  const std::string umlauts = "B\u00e4ume \u6811", lengthy(10000, 'x');
  for (const std::string name : {"a.exr", "a.png"}) {
    write_image(noise(2, 2, {0, 0, 2, 2}), folder.path(name), {{"barkridge/a", umlauts}, {"barkridge/b", lengthy}});
    const auto input = OIIO::ImageInput::open(folder.path(name));
    REQUIRE(input);
    CHECK(input->spec().get_string_attribute("barkridge/a") == umlauts);
    CHECK(input->spec().get_string_attribute("barkridge/b") == lengthy);
  }
}

TEST_CASE("what a format has no room for is an error that leaves nothing") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(write_image({0, 0, {0, 0, 0, 0}, {}}, folder.path("a.png")), Catch::Contains("a.png: "));
  CHECK_THROWS_AS(write_image(noise(2, 2, {0, 0, 2, 2}), folder.path("a.png"), {{"", "no name"}}), IoError);
  CHECK(folder.entries() == 0);
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
