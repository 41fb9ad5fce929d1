#pragma once
// An image to look things up in.

#include <memory>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace barkridge {

/// Repeats in both directions. May be asked from many threads at once.
class ImageTexture {
 public:
  virtual ~ImageTexture() = default;

  /// Linear colour at a place, u to the right and v up, 1 being the image's width and height; the mean over
  /// `footprint`, from smaller versions of the image.
  virtual glm::dvec3 color(const glm::dvec2& place, const glm::dvec2& footprint) const = 0;
};

/// Opens an image of any format that OpenImageIO reads. Integers count as sRGB, floating-point numbers as linear, and
/// one channel as grey. Tiles are read as they are needed. Loads the module `barkridge_images` [raytrace/image_file.h]
/// and waits for it. Throws `InputError` for what is no image, `IoError` without the module.
std::shared_ptr<const ImageTexture> open_texture(const std::string& path);

}  // namespace barkridge
