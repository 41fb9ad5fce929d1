// The part of the module `barkridge_images` that reads images.

#include <OpenImageIO/texture.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "raytrace/image_codecs.h"

namespace barkridge {

namespace {

// The inverse of sRGB's encoding. [IEC 61966-2-1]
double linear(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

class Texture final : public ImageTexture {
 public:
  explicit Texture(const std::string& path)
      : system_(OIIO::TextureSystem::create(false), [](OIIO::TextureSystem* s) { OIIO::TextureSystem::destroy(s); }),
        name_(path) {
    system_->attribute("automip", 1);
    system_->attribute("autotile", 64);
    system_->attribute("max_memory_MB", 256.0f);
    OIIO::ImageSpec spec;
    if (!system_->get_imagespec(name_, 0, spec)) throw std::runtime_error(system_->geterror());
    is_encoded_ = !spec.format.is_floating_point();
    channels_ = spec.nchannels >= 3 ? 3 : 1;
  }

  glm::dvec3 color(const glm::dvec2& place, const glm::dvec2& footprint) const override {
    OIIO::TextureOpt options;
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    float found[3] = {0, 0, 0};
    // Where a row of the image has its number, v has its negative.
    const double u = place.x - std::floor(place.x), v = std::ceil(place.y) - place.y;
    if (!system_->texture(name_, options, static_cast<float>(u), static_cast<float>(v), static_cast<float>(footprint.x),
                          0, 0, static_cast<float>(footprint.y), channels_, found)) {
      system_->geterror();  // a tile that cannot be read is black, and its message is not kept
    }
    if (channels_ == 1) found[1] = found[2] = found[0];
    glm::dvec3 color;
    for (int c = 0; c < 3; ++c) {
      const double value = std::max(0.0, static_cast<double>(found[c]));
      color[c] = is_encoded_ ? linear(value) : value;
    }
    return color;
  }

 private:
  std::shared_ptr<OIIO::TextureSystem> system_;
  OIIO::ustring name_;
  bool is_encoded_ = false;
  int channels_ = 3;
};

}  // namespace

ImageTexture* barkridge_open_texture(const std::string& path, std::string& reason) noexcept {
  try {
    return new Texture(path);
  } catch (const std::exception& error) {
    reason = error.what();
    return nullptr;
  }
}

}  // namespace barkridge
