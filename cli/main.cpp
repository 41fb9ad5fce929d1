#include <tbb/global_control.h>

#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/results.h"
#include "cli/signals.h"
#include "cli/verbs.h"

namespace barkridge::cli {

namespace {

constexpr int kFailure = 1;
constexpr int kBadInput = 2;

int complain(const std::string& message, int status) {
  std::cerr << "barkridge: " + message + '\n';
  return status;
}

void work(int argc, const char* const* argv) {
  const std::variant<Command, HelpText> asked = parse_command_line(argc, argv);
  if (const auto* help = std::get_if<HelpText>(&asked)) return write_results(help->text);
  const Command& command = std::get<Command>(asked);
  std::optional<tbb::global_control> threads;
  if (command.threads > 0) {
    threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(command.threads));
  }
  std::visit([](const auto& arguments) { run(arguments); }, command.verb);
}

int run_program(int argc, const char* const* argv) {
  prepare_process();
  try {
    work(argc, argv);
    return 0;
  } catch (const InputError& error) {
    return complain(error.what(), kBadInput);
  } catch (const ReaderGone&) {
    return kFailure;
  } catch (const std::bad_alloc&) {
    return complain("out of memory", kFailure);
  } catch (const std::exception& error) {
    return complain(error.what(), kFailure);
  }
}

}  // namespace

}  // namespace barkridge::cli

int main(int argc, char** argv) { return barkridge::cli::run_program(argc, argv); }
