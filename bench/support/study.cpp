#include "bench/support/study.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace barkridge::bench {

namespace {

std::string to_text(const nlohmann::ordered_json& cell) {
  if (cell.is_string()) return cell.get<std::string>();
  if (cell.is_number_integer()) return fmt::format("{}", cell.get<std::int64_t>());
  if (!cell.is_number() || !std::isfinite(cell.get<double>())) return "-";
  constexpr int kDigits = 3;
  const double value = std::stod(fmt::format("{:.{}e}", cell.get<double>(), kDigits - 1));
  const int magnitude = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fmt::format("{:.{}f}", value, std::clamp(kDigits - 1 - magnitude, 0, 9));
}

void print(const Table& table) {
  std::vector<std::vector<std::string>> lines{table.columns};
  for (const auto& row : table.rows) {
    lines.emplace_back();
    for (const nlohmann::ordered_json& cell : row) lines.back().push_back(to_text(cell));
  }
  std::vector<std::size_t> widths(table.columns.size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text = fmt::format("\n{}\n", table.title);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) text += fmt::format("  {:>{}}", line[i], widths[i]);
    text += '\n';
  }
  for (const std::string& note : table.notes) text += fmt::format("  ({})\n", note);
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error(fmt::format("cannot write {}", path));
}

}  // namespace

Study::Study(std::string name, std::string question) : name_(std::move(name)), question_(std::move(question)) {}

void Study::add(Table table) {
  if (table.rows.empty()) return;
  if (tables_.empty()) fmt::print("{}\n", question_);
  print(table);
  tables_.push_back(std::move(table));
}

void Study::figure(const std::string& name, double value) { figures_[name] = value; }

nlohmann::ordered_json Study::to_json() const {
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  for (const Table& table : tables_) {
    tables.push_back(
        {{"title", table.title}, {"columns", table.columns}, {"rows", table.rows}, {"notes", table.notes}});
  }
  return {{"program", name_},
          {"question", question_},
          {"date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))},
          {"machine", machine_},
          {"figures", figures_},
          {"tables", tables}};
}

void add_picture_option(CLI::App& app, int& width, int& height) {
  const auto set = [&](const std::vector<int>& size) {
    width = size[0];
    height = size[1];
  };
  app.add_option_function<std::vector<int>>("--picture", set, "Width and height in pixels")
      ->delimiter(',')
      ->expected(2)
      ->default_str(fmt::format("{},{}", width, height));
}

int run_study(int argc, char** argv, Study study, const std::function<void(CLI::App&)>& add_options,
              const std::function<void(Study&)>& measure) {
  CLI::App app;
  std::string json;
  app.add_option("--json", json, "Also write the tables to this file");
  add_options(app);
  CLI11_PARSE(app, argc, argv);
  try {
    measure(study);
    if (!json.empty()) write_file(json, study.to_json().dump(1) + '\n');
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 1;
  }
}

}  // namespace barkridge::bench
