#pragma once

#include <string>
#include <string_view>

namespace barkridge {

/// The text with `& < > "` as HTML and SVG write them.
std::string escaped(std::string_view text);

}  // namespace barkridge
