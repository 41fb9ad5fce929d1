#pragma once
// Preprocessed text that remembers where its author wrote each byte.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace barkridge {

/// A text made of pieces of files. An error at any byte of it can be shown in the file that a person edits.
class SourceText {
 public:
  using FileId = std::uint32_t;

  /// Adds a file that pieces come from. Its text is kept, for messages.
  FileId add_file(std::string name, std::string text);
  const std::string& file_text(FileId file) const { return files_[file].text; }
  const std::string& file_name(FileId file) const { return files_[file].name; }

  /// From byte `offset` of `file` on, messages call the file `name` and count lines from `line` (a `# 12 "file"`
  /// marker).
  void mark_line(FileId file, std::size_t offset, int line, std::string name);

  /// Appends a byte that stands at `offset` of `file`.
  void append(char byte, FileId file, std::size_t offset);
  /// Appends text that does not stand in the file itself but came from the macro used at `offset`.
  void append_expansion(std::string_view text, FileId file, std::size_t offset);

  std::string_view text() const { return text_; }
  /// Where the author wrote the byte at `offset` of `text()`; its end is shown at the last byte, a newline.
  SourceLocation place(std::size_t offset) const;
  /// The same for a byte of a file.
  SourceLocation place_in_file(FileId file, std::size_t offset) const;

 private:
  struct LineMarker {
    std::size_t offset;
    int line;
    std::string name;
  };
  struct File {
    std::string name;
    std::string text;
    std::vector<LineMarker> markers;
  };
  /// Bytes from `begin` on stand at `offset` and after it, or all at `offset` if they came from a macro.
  struct Run {
    std::size_t begin;
    std::size_t offset;
    FileId file;
    bool expansion;
  };

  std::string text_;
  std::vector<File> files_;
  std::vector<Run> runs_;
};

/// "file:line:column: message", the form of warnings.
std::string message_at(const SourceLocation& place, const std::string& message);

}  // namespace barkridge
