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

// What both formats share.
OIIO::ImageSpec common_spec(const EncodedPixels& pixels, const ImageMetadata& metadata, OIIO::TypeDesc format) {
  const PixelRegion& region = pixels.region;
  OIIO::ImageSpec spec(region.width, region.height, 4, format);
  spec.x = region.x;
  spec.y = region.y;
  spec.full_width = pixels.full_width;
  spec.full_height = pixels.full_height;
  for (const auto& [name, text] : metadata) spec.attribute(name, text);
  return spec;
}

void encode(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const EncodedPixels& pixels,
            ImageSink& sink) {
  SinkProxy proxy(sink);
  const auto output = OIIO::ImageOutput::create(format, &proxy);
  if (!output) throw std::runtime_error(OIIO::geterror());
  const bool done = output->open(pixels.path, spec) && output->write_image(type, pixels.rgba) && output->close();
  if (!done) throw std::runtime_error(output->geterror());
}

void encode_exr(const EncodedPixels& pixels, const ImageMetadata& metadata, ImageSink& sink) {
  OIIO::ImageSpec spec = common_spec(pixels, metadata, OIIO::TypeDesc::HALF);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709);
  // Without a date of ours the time of writing gets in.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  encode("openexr", spec, OIIO::TypeDesc::FLOAT, pixels, sink);
}

void encode_png(const EncodedPixels& pixels, const ImageMetadata& metadata, ImageSink& sink) {
  OIIO::ImageSpec spec = common_spec(pixels, metadata, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // Grain hides the likeness of neighbours, so that rows as they are make smaller files of most pictures than
  // differences do, and the level takes a quarter of the default's time.
  constexpr int kNoFilter = 0x08;
  spec.attribute("png:compressionLevel", 4);
  spec.attribute("png:filter", kNoFilter);
  encode("png", spec, OIIO::TypeDesc::UINT8, pixels, sink);
}

}  // namespace

CodecStatus barkridge_encode_image(const EncodedPixels& pixels, const ImageMetadata& metadata, ImageSink& sink,
                                   std::string& reason) noexcept {
  try {
    (pixels.format == EncodedPixels::Format::kExr ? encode_exr : encode_png)(pixels, metadata, sink);
    return CodecStatus::kDone;
  } catch (const std::bad_alloc&) {
    return CodecStatus::kOutOfMemory;
  } catch (const std::exception& error) {
    reason = error.what();
    return CodecStatus::kFailed;
  }
}

}  // namespace barkridge
