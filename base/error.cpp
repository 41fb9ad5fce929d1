#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace barkridge {

namespace {

// Tabs are kept in front of the caret so that it stays below its column however wide a tab is shown.
std::string caret_below(const std::string& line, int column) {
  std::string pad;
  for (int i = 0; i + 1 < column && i < static_cast<int>(line.size()); ++i) {
    const auto byte = static_cast<unsigned char>(line[static_cast<std::size_t>(i)]);
    if (byte == '\t') {
      pad += '\t';
    } else if ((byte & 0xC0) != 0x80) {  // one blank a character, not one a byte of UTF-8
      pad += ' ';
    }
  }
  return pad + '^';
}

std::string person_message(const SourceLocation& where, const std::string& message) {
  std::string text;
  if (!where.file.empty()) text += where.file + ':';
  if (where.line > 0) text += fmt::format("{}:{}:", where.line, where.column);
  if (!text.empty()) text += ' ';
  text += message;
  if (where.line > 0 && !where.line_text.empty()) {
    text += fmt::format("\n  {}\n  {}", where.line_text, caret_below(where.line_text, where.column));
  }
  return text;
}

}  // namespace

SourceLocation locate(std::string_view text, std::size_t offset, const std::string& file) {
  offset = std::min(offset, text.size());
  const std::string_view before = text.substr(0, offset);
  const std::size_t newline = before.rfind('\n');
  const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  std::string_view line = text.substr(start, text.find('\n', start) - start);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return {file, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(offset - start), std::string(line)};
}

InputError::InputError(const std::string& message) : std::runtime_error(message), message_(message) {}

InputError::InputError(const SourceLocation& where, const std::string& message)
    : std::runtime_error(person_message(where, message)), where_(where), message_(message) {}

IoError::IoError(const std::string& path, const std::string& reason) : std::runtime_error(path + ": " + reason) {}

Cancelled::Cancelled() : std::runtime_error("cancelled") {}

}  // namespace barkridge
