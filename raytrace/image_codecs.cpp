#include "raytrace/image_codecs.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <new>
#include <stdexcept>

namespace barkridge {

namespace {

// OpenImageIO's view of a sink.
class SinkProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit SinkProxy(ImageSink& sink) : IOProxy("", Write), sink_(sink) {}

  const char* proxytype() const override { return "barkridge"; }
  int64_t tell() override { return sink_.position(); }
  bool seek(int64_t offset) override {
    sink_.seek(offset);
    return true;
  }
  size_t write(const void* data, size_t size) override {
    sink_.write(data, size);
    return size;
  }
  size_t pwrite(const void* data, size_t size, int64_t offset) override {
    const int64_t position = sink_.position();
    sink_.seek(offset);
    sink_.write(data, size);
    sink_.seek(position);
    return size;
  }
  size_t size() const override { return static_cast<size_t>(sink_.size()); }

 private:
  ImageSink& sink_;
};

// Colours and layers pixel by pixel.
std::vector<float> joined(const Image& image) {
  const std::size_t layers = image.layer_names.size();
  std::vector<float> all;
  all.reserve(image.rgba.size() + image.layers.size());
  for (std::size_t pixel = 0; 4 * pixel < image.rgba.size(); ++pixel) {
    const float *color = &image.rgba[4 * pixel], *layer = &image.layers[layers * pixel];
    all.insert(all.end(), color, color + 4);
    all.insert(all.end(), layer, layer + layers);
  }
  return all;
}

void encode(const Image& image, const std::string& path, const ImageMetadata& metadata, ImageSink& sink) {
  const PixelRegion& region = image.region;
  const std::size_t layers = image.layer_names.size();
  OIIO::ImageSpec spec(region.width, region.height, 4 + static_cast<int>(layers), OIIO::TypeDesc::HALF);
  if (layers > 0) {
    spec.channelformats.assign(4, OIIO::TypeDesc::HALF);
    spec.channelformats.resize(4 + layers, OIIO::TypeDesc::FLOAT);
    spec.channelnames.insert(spec.channelnames.begin() + 4, image.layer_names.begin(), image.layer_names.end());
    spec.channelnames.resize(4 + layers);
  }
  spec.x = region.x;
  spec.y = region.y;
  spec.full_width = image.full_width;
  spec.full_height = image.full_height;
  for (const auto& [name, text] : metadata) spec.attribute(name, text);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709);
  // Without a date of ours the time of writing gets in.
  spec.attribute("DateTime", "1970:01:01 00:00:00");

  SinkProxy proxy(sink);
  const auto output = OIIO::ImageOutput::create("openexr", &proxy);
  if (!output) throw std::runtime_error(OIIO::geterror());
  const bool done = output->open(path, spec) &&
                    output->write_image(OIIO::TypeDesc::FLOAT, layers > 0 ? joined(image).data() : image.rgba.data()) &&
                    output->close();
  if (!done) throw std::runtime_error(output->geterror());
}

}  // namespace

CodecStatus barkridge_encode_exr(const Image& image, const std::string& path, const ImageMetadata& metadata,
                                 ImageSink& sink, std::string& reason) noexcept {
  try {
    encode(image, path, metadata, sink);
    return CodecStatus::kDone;
  } catch (const std::bad_alloc&) {
    return CodecStatus::kOutOfMemory;
  } catch (const std::exception& error) {
    reason = error.what();
    return CodecStatus::kFailed;
  }
}

}  // namespace barkridge
