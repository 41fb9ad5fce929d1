#include "cli/results.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace barkridge::cli {

void write_results(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EPIPE) {
      throw ReaderGone();
    } else if (errno != EINTR) {
      throw IoError("standard output", std::strerror(errno));
    }
  }
}

}  // namespace barkridge::cli
