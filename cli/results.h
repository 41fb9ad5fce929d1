#pragma once
// The standard output, which carries results and nothing else.

#include <exception>
#include <string_view>

namespace barkridge::cli {

/// Whoever read the results wants no more of them.
struct ReaderGone : std::exception {
  const char* what() const noexcept override { return "standard output: nobody reads it"; }
};

/// Writes all of it at once. Throws `ReaderGone` when the pipe is closed, `IoError` for every other failure.
void write_results(std::string_view text);

}  // namespace barkridge::cli
