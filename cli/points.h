#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/geometry.h"

namespace barkridge::cli {

/// The point on a line `x y z`; nothing on a blank line or a comment, which starts with #. Throws `InputError`, with
/// `file` and `line_number` as place, for everything else and for numbers that are not finite.
std::optional<Vec3> parse_point(std::string_view line, const std::string& file, int line_number);

}  // namespace barkridge::cli
