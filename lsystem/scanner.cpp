#include "lsystem/scanner.h"

#include <fmt/format.h>

#include "lsystem/characters.h"

namespace barkridge {

void Scanner::skip_blanks() {
  while (position_ < text_.size()) {
    if (is_blank(text_[position_]) || (text_[position_] == '\n' && braces_ > 0)) {
      ++position_;
    } else if (text_.substr(position_).starts_with("\n\t")) {
      position_ += 2;
    } else {
      return;
    }
  }
}

char Scanner::peek() {
  skip_blanks();
  return position_ < text_.size() ? text_[position_] : '\0';
}

char Scanner::peek_second() {
  skip_blanks();
  return position_ + 1 < text_.size() ? text_[position_ + 1] : '\0';
}

bool Scanner::accept(std::string_view token) {
  skip_blanks();
  if (!text_.substr(position_).starts_with(token)) return false;
  position_ += token.size();
  return true;
}

void Scanner::expect(std::string_view token, std::string_view where) {
  if (accept(token)) return;
  fail(fmt::format("expected `{}` {}, not {}", token, where, describe_next()));
}

bool Scanner::accept_keyword(std::string_view pattern) {
  skip_blanks();
  std::size_t at = position_;
  bool word_start = true;
  for (const char expected : pattern) {
    const char actual = at < text_.size() ? text_[at] : '\0';
    if (expected == '~' || expected == '|') {
      if (expected == '~' && actual == ' ') ++at;
      word_start = true;
      continue;
    }
    const bool capital = word_start && is_letter(expected) && actual == expected - 'a' + 'A';
    if (actual != expected && !capital) return false;
    word_start = expected == ' ';
    ++at;
  }
  position_ = at;
  return true;
}

bool Scanner::at_arrow() {
  skip_blanks();
  const std::string_view rest = text_.substr(position_);
  return rest.starts_with("-->") || rest.starts_with("-o>");
}

bool Scanner::at_end() {
  skip_blanks();
  return position_ >= text_.size();
}

bool Scanner::at_line_end() {
  const char next = peek();
  return next == '\n' || (next == '\0' && position_ >= text_.size());
}

void Scanner::expect_line_end(std::string_view after) {
  if (!at_line_end()) fail(fmt::format("unexpected {} after {}", describe_next(), after));
  if (position_ < text_.size()) ++position_;
}

void Scanner::skip_empty_lines() {
  while (!at_end() && at_line_end()) ++position_;
}

std::string Scanner::accept_name() {
  skip_blanks();
  const std::size_t start = position_;
  if (position_ < text_.size() && is_letter(text_[position_])) {
    while (position_ < text_.size() && is_name_character(text_[position_])) ++position_;
  }
  return std::string(text_.substr(start, position_ - start));
}

std::string_view Scanner::rest_of_line() {
  skip_blanks();
  const std::size_t start = position_;
  while (!at_line_end()) ++position_;
  return text_.substr(start, position_ - start);
}

std::uint32_t Scanner::place() {
  skip_blanks();
  return static_cast<std::uint32_t>(position_);
}

void Scanner::fail_at(std::size_t offset, const std::string& message) const {
  throw InputError(source_.place(offset), message);
}

void Scanner::fail(const std::string& message) { fail_at(place(), message); }

std::string Scanner::describe_next() {
  if (at_end()) return "the end of the file";
  const char next = peek();
  if (next == '\n') return "the end of the line";
  if (!is_visible_ascii(next)) return "this character";
  std::size_t end = position_ + 1;
  if (is_name_start(next)) {
    while (end < text_.size() && is_name_character(text_[end])) ++end;
  }
  return fmt::format("`{}`", text_.substr(position_, end - position_));
}

}  // namespace barkridge
