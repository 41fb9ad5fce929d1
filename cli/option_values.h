#pragma once
// Values of options that are no plain numbers.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace barkridge::cli {

/// Integers of at least 0 with these separators between them, like 640x480+10+20 for "x++"; nothing if the text is
/// anything else.
std::optional<std::vector<int>> integers_between(std::string_view text, std::string_view separators);

/// A number of bytes, with a unit K, M, G or T (powers of 1024) or none; nothing if the text is anything else.
std::optional<std::uint64_t> bytes_of(std::string_view text);

}  // namespace barkridge::cli
