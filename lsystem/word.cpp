#include "lsystem/word.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "lsystem/characters.h"

namespace barkridge {

namespace {

constexpr std::size_t kLineLength = 70;

/// C's `%g`.
void append_number(float value, std::string& text) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, double{value}, std::chars_format::general, 6).ptr;
  text.append(digits, end);
}

class WordReader {
 public:
  WordReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Word read() {
    for (skip_space(); position_ < text_.size(); skip_space()) read_module();
    if (!open_brackets_.empty()) fail(open_brackets_.back(), "this `[` lacks its `]`");
    return std::move(word_);
  }

 private:
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    throw InputError(locate(text_, offset, file_), message);
  }

  void skip_space() {
    while (position_ < text_.size() && is_space(text_[position_])) ++position_;
  }

  void read_module() {
    const std::size_t start = position_++;
    const char symbol = text_[start];
    if (!is_visible_ascii(symbol)) fail(start, "modules are single visible ASCII characters");
    if (symbol == '(' || symbol == ')') fail(start, fmt::format("`{}` without a module before it", symbol));
    if (symbol == '[') open_brackets_.push_back(start);
    if (symbol == ']') {
      if (open_brackets_.empty()) fail(start, "this `]` lacks its `[`");
      open_brackets_.pop_back();
    }
    const std::size_t first = word_.parameters.size();
    skip_space();
    if (position_ < text_.size() && text_[position_] == '(') read_parameters(start, first);
    if (word_.modules.size() >= std::numeric_limits<std::uint32_t>::max() ||
        word_.parameters.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw LimitError(locate(text_, start, file_), "a word has at most 4294967295 modules or parameters");
    }
    word_.modules.push_back(
        {symbol, static_cast<std::uint8_t>(word_.parameters.size() - first), 0, static_cast<std::uint32_t>(first)});
  }

  void read_parameters(std::size_t module, std::size_t first) {
    char separator = '(';
    while (separator != ')') {
      ++position_;  // the `(` or a comma
      read_number();
      skip_space();
      if (position_ == text_.size()) fail(module, "this module's parameters lack their `)`");
      separator = text_[position_];
      if (separator != ',' && separator != ')') fail(position_, "expected `,` or `)` after a parameter");
      if (word_.parameters.size() - first > 255) fail(module, "a module has at most 255 parameters");
    }
    ++position_;
  }

  void read_number() {
    skip_space();
    const std::size_t start = position_;
    if (position_ < text_.size() && text_[position_] == '+') ++position_;
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + position_, text_.data() + text_.size(), value);
    if (error == std::errc::invalid_argument) fail(start, "expected a number");
    if (std::isnan(value)) fail(start, "this parameter is not a number (nan)");
    if (std::isinf(value)) fail(start, "this parameter is infinite");
    // Numbers too small become 0.
    const auto stored = static_cast<float>(value);
    const auto length = static_cast<std::size_t>(end - text_.data()) - position_;
    const bool small =
        text_.substr(position_, length).find_first_of("eE") + 1 == text_.substr(position_, length).find('-', 1);
    const bool too_large = std::isinf(stored) || (error == std::errc::result_out_of_range && !small);
    if (too_large) fail(start, "this parameter is too large");
    word_.parameters.push_back(stored);
    position_ += length;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t position_ = 0;
  std::vector<std::size_t> open_brackets_;
  Word word_;
};

}  // namespace

std::string to_string(const Word& word) {
  std::string text;
  std::size_t on_line = 0;
  for (const Word::Module& module : word.modules) {
    if (on_line >= kLineLength) {
      text += '\n';
      on_line = 0;
    }
    const std::size_t start = text.size();
    text += module.symbol;
    char separator = '(';
    for (const float value : word.parameters_of(module)) {
      text += separator;
      append_number(value, text);
      separator = ',';
    }
    if (module.parameter_count > 0) text += ')';
    const std::size_t commas = module.parameter_count > 0 ? module.parameter_count - 1u : 0u;
    on_line += text.size() - start - commas;
  }
  return text;
}

Word parse_word(std::string_view text, const std::string& file) { return WordReader(text, file).read(); }

}  // namespace barkridge
