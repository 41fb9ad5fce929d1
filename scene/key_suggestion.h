#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace barkridge {

/// The name that somebody who wrote `written` most likely meant: the nearest by edit distance, or the one that has it
/// as its last part. Empty if none is near.
std::string nearest_name(std::string_view written, const std::vector<std::string>& names);

}  // namespace barkridge
