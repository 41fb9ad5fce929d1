#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "lsystem/source_text.h"

namespace barkridge {

/// A position in preprocessed L-system text. Blanks, and a newline followed by a tab, separate nothing; other newlines
/// end statements, except inside braces.
class Scanner {
 public:
  explicit Scanner(const SourceText& source) : source_(source), text_(source.text()) {}

  void skip_blanks();
  /// The next character after blanks; a newline at a statement's end, '\0' at the end of the text.
  char peek();
  /// The next two characters after blanks.
  char peek_second();
  /// Passes this token if it comes next after blanks.
  bool accept(std::string_view token);
  void expect(std::string_view token, std::string_view where);
  /// Passes a keyword at the start of a statement. In `pattern`, words are separated by a blank that must be there ' ',
  /// may be there '~', or may not be there '|'; the first letter of each word may be a capital.
  bool accept_keyword(std::string_view pattern);
  /// Whether `-->` or its relative `-o>` comes next.
  bool at_arrow();
  bool at_end();
  bool at_line_end();
  void expect_line_end(std::string_view after);
  void skip_empty_lines();
  /// A name if one comes next, or an empty string.
  std::string accept_name();
  /// The rest of the line, to the newline, which is left.
  std::string_view rest_of_line();

  void open_brace() { ++braces_; }
  void close_brace() { --braces_; }

  std::size_t position() const { return position_; }
  void set_position(std::size_t position) { position_ = position; }
  std::string_view text() const { return text_; }
  /// The offset of what comes next, for messages and instructions.
  std::uint32_t place();

  /// Throws `InputError` at an offset of the text, or at what comes next.
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;
  [[noreturn]] void fail(const std::string& message);
  /// "`x`", "the end of the line" or "the end of the file": what comes next, for messages.
  std::string describe_next();

 private:
  const SourceText& source_;
  std::string_view text_;
  std::size_t position_ = 0;
  int braces_ = 0;
};

}  // namespace barkridge
