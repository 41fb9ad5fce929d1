#pragma once
// The program without its process, for what needs no exit status: many times as fast.

#include <string>
#include <variant>
#include <vector>

#include "cli/command_line.h"
#include "cli/verbs.h"

inline std::variant<barkridge::cli::Command, barkridge::cli::HelpText> parse(
    const std::vector<std::string>& arguments) {
  std::vector<const char*> argv = {"barkridge"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  return barkridge::cli::parse_command_line(static_cast<int>(argv.size()), argv.data());
}

inline std::string help_of(const std::vector<std::string>& arguments) {
  return std::get<barkridge::cli::HelpText>(parse(arguments)).text;
}

/// Does what the arguments say; for work that ends in an exception.
inline void run_in_process(const std::vector<std::string>& arguments) {
  std::visit([](const auto& verb) { run(verb); }, std::get<barkridge::cli::Command>(parse(arguments)).verb);
}
