#pragma once
// Classes of ASCII characters, whatever the locale.

#include <string_view>

namespace barkridge {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
constexpr bool is_space(char c) { return is_blank(c) || c == '\n'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr bool is_name_start(char c) { return is_letter(c) || c == '_'; }
constexpr bool is_name_character(char c) { return is_name_start(c) || is_digit(c); }
/// Whether one byte is a character that a person can see: neither control nor part of a longer UTF-8 sequence.
constexpr bool is_visible_ascii(char c) { return c > ' ' && c < '\x7f'; }

constexpr std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace barkridge
