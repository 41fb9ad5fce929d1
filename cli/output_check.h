#pragma once

#include <string>

namespace barkridge::cli {

/// Throws `IoError` now, before the long job, if a file of this name could not be written after it.
void check_writable(const std::string& path);

}  // namespace barkridge::cli
