#pragma once

#include <string>
#include <variant>

#include "cli/verbs.h"

namespace barkridge::cli {

struct Command {
  Verb verb;
  int threads = 0;  ///< 0 for all that the machine has
};

/// A text that the user asked for instead of work: help, version.
struct HelpText {
  std::string text;
};

/// Reads the command line. Throws `InputError` for bad usage.
std::variant<Command, HelpText> parse_command_line(int argc, const char* const* argv);

}  // namespace barkridge::cli
