#pragma once
// A study asks one question, answers it in tables for people and in figures for bench/report, and writes both as JSON.

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/support/machine.h"

namespace barkridge::bench {

/// Cells are texts, whole numbers, numbers (shown with three digits), or null where there is nothing to say.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<nlohmann::ordered_json>> rows;
  std::vector<std::string> notes;
};

class Study {
 public:
  Study(std::string name, std::string question);

  /// Prints the table and keeps it, unless it has no rows.
  void add(Table table);
  /// A number that bench/report holds against a goal; NaN says that measuring it failed.
  void figure(const std::string& name, double value);

  nlohmann::ordered_json to_json() const;

 private:
  std::string name_, question_;
  nlohmann::ordered_json machine_ = machine_facts();
  std::vector<Table> tables_;
  nlohmann::ordered_json figures_ = nlohmann::ordered_json::object();
};

/// `--picture WIDTH,HEIGHT`.
void add_picture_option(CLI::App& app, int& width, int& height);

/// The main function of a study: reads the command line, to which `add_options` adds, measures, and writes the file
/// that
/// `--json` asks for. Returns the exit status.
int run_study(int argc, char** argv, Study study, const std::function<void(CLI::App&)>& add_options,
              const std::function<void(Study&)>& measure);

}  // namespace barkridge::bench
