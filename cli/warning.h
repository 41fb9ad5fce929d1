#pragma once

#include <string>

namespace barkridge::cli {

/// Tells the user, on the standard error, of something odd that does not stop the work.
void warn(const std::string& message);

}  // namespace barkridge::cli
