#pragma once
// Pictures on the disk.

#include <string>
#include <utility>
#include <vector>

#include "raytrace/render.h"

namespace barkridge {

/// Names and texts for a picture's header, such as {"barkridge/version", "0.1.0"}. Nothing that may differ between
/// equal pictures belongs here.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

/// Throws `InputError` unless `write_image` knows the format by the path's extension. For a look before a long job.
void check_image_path(const std::string& path);

/// Whether the format of a checked path has room for layers: EXR has.
bool can_hold_layers(const std::string& path);

/// The codec of EXR is a module of its own, because the libraries below it take longer to load than a small tree takes
/// to grow. It is looked for as the program's shared libraries are, by the program's run path first: CMake's targets
/// set it to the module's place in the build tree and in the installed one, wherever that has been moved to as a whole.
///
/// Begins to load it on a thread of its own, if one of the paths needs it and nothing has yet; the program's exit waits
/// for that. Throws `IoError` once it is known that it cannot be loaded: long jobs call this again at times, so as not
/// to find out at their end. Never waits.
void prepare_image_writing(const std::vector<std::string>& paths);

/// Writes a picture whole or not at all, in the format of the path's extension (upper or lower case):
///   .exr  linear half floats, premultiplied RGBA, Rec. 709 primaries, zip; a region becomes the data window of the
///         full display window. Metadata become attributes, layers further channels of
///         single precision.
///   .png  8-bit sRGB with unassociated alpha, values clipped at white; a region has its place in the oFFs chunk.
///         Metadata become text chunks, under names of at most 79 letters.
/// Equal pictures and metadata give equal bytes. Waits for the module where it is needed, prepared or not. Throws
/// `InputError` for other extensions, `IoError`.
void write_image(const Image& image, const std::string& path, const ImageMetadata& metadata = {});

}  // namespace barkridge
