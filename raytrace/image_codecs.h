#pragma once
// What passes between the library and the module `barkridge_images`, which alone knows OpenImageIO. No exception does.

#include <cstddef>
#include <cstdint>
#include <string>

#include "raytrace/image_file.h"
#include "raytrace/image_texture.h"

namespace barkridge {

/// Where a codec's bytes go. Codecs mishandle failing writes (some hang, some report success), so they are never told
/// of one: whoever owns the sink remembers it.
class ImageSink {
 public:
  virtual void write(const void* data, std::size_t size) = 0;
  virtual void seek(std::int64_t position) = 0;
  virtual std::int64_t position() const = 0;
  virtual std::int64_t size() const = 0;

 protected:
  ~ImageSink() = default;
};

enum class CodecStatus { kDone, kFailed, kOutOfMemory };

/// Writes the bytes of an EXR into the sink. The path is for messages; `reason` is set
/// where the status is `kFailed`.
extern "C" CodecStatus barkridge_encode_exr(const Image& image, const std::string& path, const ImageMetadata& metadata,
                                            ImageSink& sink, std::string& reason) noexcept;

/// Opens an image; null, and a reason, if that fails. The caller deletes it.
extern "C" ImageTexture* barkridge_open_texture(const std::string& path, std::string& reason) noexcept;

}  // namespace barkridge
