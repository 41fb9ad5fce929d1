#pragma once
// The kinds of failure that cross a room's door. Libraries throw them and never print or exit; degenerate geometry is
// no error but has a defined result, documented where it occurs.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace barkridge {

/// A place in a text that somebody wrote. `line` and `column` count from 1; 0 means unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
  /// The whole line without its newline, for the message; may be empty.
  std::string line_text;
};

/// The place of byte `offset` in `text`. A newline belongs to the line that it ends.
SourceLocation locate(std::string_view text, std::size_t offset, const std::string& file);

/// What somebody wrote cannot be used. `what()` is the whole message for a person:
///     file:line:column: message
///       the line
///           ^
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message);
  InputError(const SourceLocation& where, const std::string& message);

  const SourceLocation& where() const { return where_; }
  /// The message without place, line and caret.
  const std::string& message() const { return message_; }

 private:
  SourceLocation where_;
  std::string message_;
};

/// A stated limit was reached before the memory or time was spent; the message names the limit and how to raise it.
class LimitError : public InputError {
 public:
  using InputError::InputError;
};

/// Reading or writing failed: missing file, no permission, disk full. The message names the path and the reason.
class IoError : public std::runtime_error {
 public:
  IoError(const std::string& path, const std::string& reason);
};

/// A progress callback asked to stop.
class Cancelled : public std::runtime_error {
 public:
  Cancelled();
};

}  // namespace barkridge
