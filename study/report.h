#pragma once
// A report of tables, plots and pictures, as one HTML file that needs nothing else, as JSON and as CSV.

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "study/plot.h"

namespace barkridge {

/// Cells are texts, whole numbers, numbers (shown with three digits) or null where there is nothing to say.
struct ReportTable {
  std::string name;  ///< a word: of its CSV file and in the JSON
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<nlohmann::ordered_json>> rows;
};

struct ReportPicture {
  std::string caption;
  std::string png;  ///< the file's bytes
};

struct ReportSection {
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<ReportTable> tables;
  std::vector<Plot> plots;
  std::vector<ReportPicture> pictures;
};

struct Report {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< about machine and program
  std::vector<ReportSection> sections;
};

/// A whole page with plots as SVG and pictures inside it.
std::string html(const Report& report);

/// Facts, and each table by its name as a list of objects with the columns as keys.
nlohmann::ordered_json json(const Report& report);

/// The table as RFC 4180 has it: a line of columns, then a line a row; numbers with all their digits.
std::string csv(const ReportTable& table);

}  // namespace barkridge
