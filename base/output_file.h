#pragma once
// Files that appear whole or not at all.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace barkridge {

/// A file being written beside its target and renamed over it by `commit`, after everything is on the disk. Until then,
/// and for ever if an error or a destructor comes first, the old file stays as it is and no litter is left. The
/// temporary file is also removed when a signal ends the program, see `remove_unfinished_outputs`.
///
/// Errors are latched: `write` never fails visibly, `commit` throws the first error as `IoError`. That lets codecs that
/// mishandle a full disk write into it without harm.
class OutputFile {
 public:
  /// Throws `IoError` if the target's directory cannot be written or the target is a directory.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends at the current position.
  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Moves the position, which may lie past the end.
  void seek(std::int64_t position);
  std::int64_t position() const { return position_; }
  std::int64_t size() const { return size_; }
  /// Reads back what was written; returns the bytes read.
  std::size_t read_at(void* data, std::size_t size, std::int64_t position);

  /// Whether an error has been latched; long writers stop early then.
  bool failed() const { return error_ != 0; }

  /// Flushes to disk and renames over the target. Throws `IoError`; then nothing has changed.
  void commit();

 private:
  void flush();

  std::string path_;
  std::string temporary_path_;
  int descriptor_ = -1;
  int error_ = 0;
  int registration_ = -1;
  std::int64_t position_ = 0;
  std::int64_t size_ = 0;
  std::int64_t buffer_start_ = 0;
  std::string buffer_;
};

/// Unlinks the temporary file of every `OutputFile` that is still open. Safe to call from a signal handler.
void remove_unfinished_outputs() noexcept;

/// The whole content of a file. Throws `IoError` when it cannot be read, `LimitError` when it is longer than `limit`.
std::string read_file(const std::string& path, std::size_t limit = std::size_t{1} << 32);

}  // namespace barkridge
