#include "cli/points.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace barkridge::cli {

namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::optional<double> finite_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double number = 0;
  const auto [after, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || after != word.data() + word.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace

std::optional<Vec3> parse_point(std::string_view line, const std::string& file, int line_number) {
  const auto fail = [&](std::size_t offset, const std::string& message) {
    SourceLocation place = locate(line, offset, file);
    place.line = line_number;
    throw InputError(place, message);
  };
  Vec3 point(0);
  int count = 0;
  std::size_t i = line.find_first_not_of(kBlanks);
  while (i < line.size() && line[i] != '#') {
    const std::size_t end = std::min(line.find_first_of(" \t\r\v\f#", i), line.size());
    if (count == 3) fail(i, "expected the end of the line after x y z");
    const std::optional<double> number = finite_number(line.substr(i, end - i));
    if (!number) fail(i, fmt::format("expected a finite number, not {}", line.substr(i, end - i)));
    point[count++] = *number;
    i = line.find_first_not_of(kBlanks, end);
  }
  if (count == 0) return std::nullopt;
  if (count < 3) fail(line.size(), fmt::format("expected three numbers x y z, not {}", count));
  return point;
}

}  // namespace barkridge::cli
