#include "raytrace/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "base/output_file.h"

namespace barkridge {

namespace {

// Hands a codec's bytes to an OutputFile. Codecs mishandle failing writes (some hang, some report success), so they are
// never told of one; OutputFile remembers it until commit.
class OutputProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit OutputProxy(OutputFile& file) : IOProxy("", Write), file_(file) {}

  const char* proxytype() const override { return "barkridge"; }
  int64_t tell() override { return file_.position(); }
  bool seek(int64_t offset) override {
    file_.seek(offset);
    return true;
  }
  size_t write(const void* data, size_t size) override {
    file_.write(data, size);
    return size;
  }
  size_t pwrite(const void* data, size_t size, int64_t offset) override {
    const int64_t position = file_.position();
    file_.seek(offset);
    file_.write(data, size);
    file_.seek(position);
    return size;
  }
  size_t size() const override { return static_cast<size_t>(file_.size()); }

 private:
  OutputFile& file_;
};

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

// What both formats share.
OIIO::ImageSpec common_spec(const Image& image, const ImageMetadata& metadata, OIIO::TypeDesc format) {
  const PixelRegion& region = image.region;
  OIIO::ImageSpec spec(region.width, region.height, 4, format);
  spec.x = region.x;
  spec.y = region.y;
  spec.full_width = image.full_width;
  spec.full_height = image.full_height;
  for (const auto& [name, text] : metadata) spec.attribute(name, text);
  return spec;
}

void write_pixels(OutputFile& file, const std::string& path, const char* format, const OIIO::ImageSpec& spec,
                  OIIO::TypeDesc type, const void* pixels) {
  OutputProxy proxy(file);
  const auto output = OIIO::ImageOutput::create(format, &proxy);
  if (!output) throw IoError(path, OIIO::geterror());
  const bool done = output->open(path, spec) && output->write_image(type, pixels) && output->close();
  if (!done && !file.failed()) throw IoError(path, output->geterror());
}

void write_exr(const Image& image, const std::string& path, const ImageMetadata& metadata, OutputFile& file) {
  OIIO::ImageSpec spec = common_spec(image, metadata, OIIO::TypeDesc::HALF);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709);
  // Without a date of ours the time of writing gets in.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  constexpr float kLargestHalf = 65504;
  std::vector<float> pixels = image.rgba;
  for (float& value : pixels) value = std::min(value, kLargestHalf);
  write_pixels(file, path, "openexr", spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

// IEC 61966-2-1.
double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::uint8_t to_byte(double unit) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(unit, 0.0, 1.0))); }

void write_png(const Image& image, const std::string& path, const ImageMetadata& metadata, OutputFile& file) {
  OIIO::ImageSpec spec = common_spec(image, metadata, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  std::vector<std::uint8_t> pixels(image.rgba.size());
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const double alpha = image.rgba[i + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      const double straight = alpha > 0 ? image.rgba[i + c] / alpha : 0.0;
      pixels[i + c] = to_byte(srgb_encoded(std::clamp(straight, 0.0, 1.0)));
    }
    pixels[i + 3] = to_byte(alpha);
  }
  write_pixels(file, path, "png", spec, OIIO::TypeDesc::UINT8, pixels.data());
}

}  // namespace

void check_image_path(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".png") {
    throw InputError(path + ": expected a name that ends in .exr or .png" +
                     (extension.empty() ? std::string() : ", not in " + extension));
  }
}

void write_image(const Image& image, const std::string& path, const ImageMetadata& metadata) {
  check_image_path(path);
  OutputFile file(path);
  (lower_extension(path) == ".exr" ? write_exr : write_png)(image, path, metadata, file);
  file.commit();
}

}  // namespace barkridge
