#include "raytrace/image_texture.h"

#include "base/error.h"
#include "raytrace/image_codecs.h"
#include "raytrace/image_module.h"

namespace barkridge {

std::shared_ptr<const ImageTexture> open_texture(const std::string& path) {
  const auto open =
      reinterpret_cast<decltype(&barkridge_open_texture)>(image_module_function("barkridge_open_texture"));
  std::string reason;
  std::shared_ptr<const ImageTexture> texture(open(path, reason));
  if (!texture) throw InputError({path, 0, 0, ""}, "expected an image: " + reason);
  return texture;
}

}  // namespace barkridge
