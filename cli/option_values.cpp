#include "cli/option_values.h"

#include <charconv>
#include <cstdint>

namespace barkridge::cli {

std::optional<std::vector<int>> integers_between(std::string_view text, std::string_view separators) {
  std::vector<int> numbers;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i <= separators.size(); ++i) {
    int number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc() || number < 0) return std::nullopt;
    numbers.push_back(number);
    at = after;
    if (i < separators.size() && (at == end || *at++ != separators[i])) return std::nullopt;
  }
  if (at != end) return std::nullopt;
  return numbers;
}

std::optional<std::uint64_t> bytes_of(std::string_view text) {
  constexpr std::string_view kUnits = "KMGT";
  std::uint64_t factor = 1;
  if (const std::size_t unit = text.empty() ? kUnits.npos : kUnits.find(text.back()); unit != kUnits.npos) {
    factor = std::uint64_t{1} << (10 * (unit + 1));
    text.remove_suffix(1);
  }
  std::uint64_t number = 0;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && after == text.data() + text.size();
  if (!whole || number > (std::uint64_t{1} << 62) / factor) return std::nullopt;
  return number * factor;
}

}  // namespace barkridge::cli
