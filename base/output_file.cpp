#include "base/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>

#include "base/error.h"
#include "base/large_room.h"

namespace barkridge {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 20;

// Paths of temporary files for the signal handler, which may neither lock nor allocate: fixed slots, each published by
// an atomic flag after its text is in place.
struct UnfinishedOutput {
  std::atomic<int> state{0};  // 0 free, 1 being filled or emptied, 2 valid
  std::array<char, 4096> path{};
};
std::array<UnfinishedOutput, 64> unfinished_outputs;

int register_unfinished(const std::string& path) {
  if (path.size() + 1 > unfinished_outputs[0].path.size()) return -1;
  for (std::size_t i = 0; i < unfinished_outputs.size(); ++i) {
    int expected = 0;
    if (unfinished_outputs[i].state.compare_exchange_strong(expected, 1)) {
      std::memcpy(unfinished_outputs[i].path.data(), path.c_str(), path.size() + 1);
      unfinished_outputs[i].state.store(2);
      return static_cast<int>(i);
    }
  }
  return -1;
}

void unregister_unfinished(int registration) {
  if (registration >= 0) unfinished_outputs[static_cast<std::size_t>(registration)].state.store(0);
}

std::string reason(int error) { return std::strerror(error); }

// Writes everything, however the kernel cuts it up. Returns 0 or errno.
int write_fully(int descriptor, const char* data, std::size_t size, std::int64_t position) {
  while (size > 0) {
    const ssize_t done = ::pwrite(descriptor, data, size, position);
    if (done < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    data += done;
    size -= static_cast<std::size_t>(done);
    position += done;
  }
  return 0;
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  // A link is followed, so that the file it names is replaced and not the link.
  std::error_code ignored;
  const std::filesystem::path resolved = std::filesystem::weakly_canonical(path_, ignored);
  if (!ignored && !resolved.empty()) path_ = resolved.string();
  struct stat status {};
  mode_t mode = 0666;
  if (::stat(path_.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw IoError(path_, "is a directory");
    if (!S_ISREG(status.st_mode)) throw IoError(path_, "is not a regular file");
    if (::access(path_.c_str(), W_OK) != 0) throw IoError(path_, reason(errno));
    mode = status.st_mode & 07777;
  }
  std::random_device entropy;
  for (int attempt = 0; attempt < 16 && descriptor_ < 0; ++attempt) {
    std::array<char, 32> suffix{};
    std::snprintf(suffix.data(), suffix.size(), ".tmp-%08x", entropy());
    temporary_path_ = path_ + suffix.data();
    descriptor_ = ::open(temporary_path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) throw IoError(path_, reason(errno));
  registration_ = register_unfinished(temporary_path_);
  buffer_.reserve(kBufferSize);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
    ::unlink(temporary_path_.c_str());
  }
  unregister_unfinished(registration_);
}

void OutputFile::flush() {
  if (buffer_.empty()) return;
  const int error = write_fully(descriptor_, buffer_.data(), buffer_.size(), buffer_start_);
  if (error_ == 0) error_ = error;
  buffer_.clear();
}

void OutputFile::write(const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  if (buffer_.empty()) buffer_start_ = position_;
  if (buffer_.size() + size > kBufferSize) {
    flush();
    buffer_start_ = position_;
  }
  if (size > kBufferSize) {
    const int error = write_fully(descriptor_, bytes, size, position_);
    if (error_ == 0) error_ = error;
  } else {
    buffer_.append(bytes, size);
  }
  position_ += static_cast<std::int64_t>(size);
  size_ = std::max(size_, position_);
}

void OutputFile::seek(std::int64_t position) {
  if (position != position_) flush();
  position_ = position;
}

std::size_t OutputFile::read_at(void* data, std::size_t size, std::int64_t position) {
  flush();
  char* bytes = static_cast<char*>(data);
  std::size_t total = 0;
  while (total < size) {
    const ssize_t done = ::pread(descriptor_, bytes + total, size - total, position + static_cast<off_t>(total));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) break;
    total += static_cast<std::size_t>(done);
  }
  return total;
}

void OutputFile::commit() {
  flush();
  if (error_ == 0 && ::fsync(descriptor_) != 0) error_ = errno;
  if (::close(descriptor_) != 0 && error_ == 0) error_ = errno;
  descriptor_ = -1;
  if (error_ == 0 && ::rename(temporary_path_.c_str(), path_.c_str()) != 0) error_ = errno;
  if (error_ != 0) {
    ::unlink(temporary_path_.c_str());
    throw IoError(path_, reason(error_));
  }
  unregister_unfinished(registration_);
  registration_ = -1;
  // The new name itself must survive a power cut; a file system that cannot promise this is no reason to fail.
  const std::string directory = std::filesystem::path(path_).parent_path().string();
  const int parent = ::open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (parent >= 0) {
    (void)::fsync(parent);
    ::close(parent);
  }
}

void remove_unfinished_outputs() noexcept {
  for (UnfinishedOutput& output : unfinished_outputs) {
    if (output.state.load() == 2) ::unlink(output.path.data());
  }
}

std::string read_file(const std::string& path, std::size_t limit) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw IoError(path, reason(errno));
  std::string content;
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && status.st_size > 0) {
    reserve_large(content, std::min(static_cast<std::size_t>(status.st_size), limit));
  }
  std::array<char, 1 << 16> chunk{};
  int error = 0;
  while (content.size() <= limit) {
    const ssize_t done = ::read(descriptor, chunk.data(), chunk.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) error = errno;
    if (done <= 0) break;
    content.append(chunk.data(), static_cast<std::size_t>(done));
  }
  ::close(descriptor);
  if (error != 0) throw IoError(path, reason(error));
  if (content.size() > limit) throw LimitError(path + ": longer than the limit of " + std::to_string(limit) + " bytes");
  return content;
}

}  // namespace barkridge
