#include "raytrace/image_file.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <new>

#include "base/output_file.h"
#include "raytrace/image_codecs.h"
#include "raytrace/image_module.h"
#include "raytrace/png_file.h"

namespace barkridge {

namespace {

using EncodeExr = decltype(&barkridge_encode_exr);

EncodeExr load_codecs() { return reinterpret_cast<EncodeExr>(image_module_function("barkridge_encode_exr")); }

const std::shared_future<EncodeExr>& codecs() {
  static const std::shared_future<EncodeExr> loaded = std::async(std::launch::async, load_codecs).share();
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

bool is_exr(const std::string& path) { return lower_extension(path) == ".exr"; }

void encode_exr(const Image& image, const std::string& path, const ImageMetadata& metadata, OutputFile& file) {
  constexpr float kLargestHalf = 65504;
  Image clipped = image;
  for (float& value : clipped.rgba) value = std::min(value, kLargestHalf);
  FileSink sink(file);
  std::string reason;
  const CodecStatus status = codecs().get()(clipped, path, metadata, sink, reason);
  if (status == CodecStatus::kOutOfMemory) throw std::bad_alloc();
  // A file that failed has the reason itself, and tells it when it is committed.
  if (status == CodecStatus::kFailed && !file.failed()) throw IoError(path, reason);
}

}  // namespace

void check_image_path(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".png") {
    throw InputError(path + ": expected a name that ends in .exr or .png" +
                     (extension.empty() ? std::string() : ", not in " + extension));
  }
}

bool can_hold_layers(const std::string& path) { return is_exr(path); }

void prepare_image_writing(const std::vector<std::string>& paths) {
  if (std::none_of(paths.begin(), paths.end(), is_exr)) return;
  const bool known = codecs().wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (known) codecs().get();
}

void write_image(const Image& image, const std::string& path, const ImageMetadata& metadata) {
  check_image_path(path);
  OutputFile file(path);
  (is_exr(path) ? encode_exr : encode_png)(image, path, metadata, file);
  file.commit();
}

}  // namespace barkridge
