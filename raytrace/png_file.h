#pragma once
// PNG, by libpng alone.

#include <string>

#include "base/output_file.h"
#include "raytrace/image_file.h"

namespace barkridge {

/// Writes the bytes that `write_image` promises for a .png into `file`, whose own failures are left to its `commit`.
/// Throws `IoError` with `path` where libpng refuses.
void encode_png(const Image& image, const std::string& path, const ImageMetadata& metadata, OutputFile& file);

}  // namespace barkridge
