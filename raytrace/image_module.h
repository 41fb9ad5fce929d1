#pragma once
// The module `barkridge_images`, loaded on first use and never unloaded: OpenImageIO's libraries are not made for that.

namespace barkridge {

/// The address of one of its functions. Throws `IoError` if it cannot be loaded.
void* image_module_function(const char* name);

}  // namespace barkridge
