#include "raytrace/image_file.h"

#include <dlfcn.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <future>
#include <new>

#include "base/output_file.h"
#include "raytrace/image_codecs.h"

namespace barkridge {

namespace {

using EncodeImage = decltype(&barkridge_encode_image);

// Never closed again: OpenImageIO's libraries are not made for that.
EncodeImage load_codecs() {
  void* const module = ::dlopen(BARKRIDGE_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
  void* const function = module == nullptr ? nullptr : ::dlsym(module, "barkridge_encode_image");
  if (function == nullptr) {
    throw IoError(BARKRIDGE_IMAGE_MODULE,
                  std::string("is needed to write pictures and cannot be loaded: ") + ::dlerror());
  }
  return reinterpret_cast<EncodeImage>(function);
}

const std::shared_future<EncodeImage>& codecs() {
  static const std::shared_future<EncodeImage> loaded = std::async(std::launch::async, load_codecs).share();
  return loaded;
}

class FileSink : public ImageSink {
 public:
  explicit FileSink(OutputFile& file) : file_(file) {}
  void write(const void* data, std::size_t size) override { file_.write(data, size); }
  void seek(std::int64_t position) override { file_.seek(position); }
  std::int64_t position() const override { return file_.position(); }
  std::int64_t size() const override { return file_.size(); }

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

// IEC 61966-2-1.
double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::uint8_t to_byte(double unit) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(unit, 0.0, 1.0))); }

std::vector<float> exr_pixels(const Image& image) {
  constexpr float kLargestHalf = 65504;
  std::vector<float> pixels = image.rgba;
  for (float& value : pixels) value = std::min(value, kLargestHalf);
  return pixels;
}

std::vector<std::uint8_t> png_pixels(const Image& image) {
  std::vector<std::uint8_t> bytes(image.rgba.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bytes.size() / 4), [&](const auto& pixels) {
    for (std::size_t i = 4 * pixels.begin(); i < 4 * pixels.end(); i += 4) {
      const double alpha = image.rgba[i + 3];
      for (std::size_t c = 0; c < 3; ++c) {
        const double straight = alpha > 0 ? image.rgba[i + c] / alpha : 0.0;
        bytes[i + c] = to_byte(srgb_encoded(std::clamp(straight, 0.0, 1.0)));
      }
      bytes[i + 3] = to_byte(alpha);
    }
  });
  return bytes;
}

void encode(const EncodedPixels& pixels, const ImageMetadata& metadata, OutputFile& file) {
  FileSink sink(file);
  std::string reason;
  const CodecStatus status = codecs().get()(pixels, metadata, sink, reason);
  if (status == CodecStatus::kOutOfMemory) throw std::bad_alloc();
  // A file that failed has the reason itself, and tells it when it is committed.
  if (status == CodecStatus::kFailed && !file.failed()) throw IoError(pixels.path, reason);
}

}  // namespace

void check_image_path(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".png") {
    throw InputError(path + ": expected a name that ends in .exr or .png" +
                     (extension.empty() ? std::string() : ", not in " + extension));
  }
}

void prepare_image_writing() {
  const bool known = codecs().wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (known) codecs().get();
}

void write_image(const Image& image, const std::string& path, const ImageMetadata& metadata) {
  check_image_path(path);
  OutputFile file(path);
  const auto write = [&](EncodedPixels::Format format, const void* rgba) {
    encode({format, path, image.full_width, image.full_height, image.region, rgba}, metadata, file);
  };
  if (lower_extension(path) == ".exr") {
    write(EncodedPixels::Format::kExr, exr_pixels(image).data());
  } else {
    write(EncodedPixels::Format::kPng, png_pixels(image).data());
  }
  file.commit();
}

}  // namespace barkridge
