#include "study/report.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include "study/markup.h"

namespace barkridge {

namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0;font-size:13px}caption{text-align:left;font-weight:bold;padding:.3em "
    "0}"
    "th,td{border-bottom:1px solid #ddd;padding:.25em "
    ".7em;text-align:right}th:first-child,td:first-child{text-align:left}"
    "td.t{text-align:left}figure{display:inline-block;margin:.5em 1em .5em 0;vertical-align:top}"
    "figcaption{font-size:13px;color:#555;max-width:420px}img{max-width:420px;height:auto}";

std::string base64(const std::string& bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  out.resize(static_cast<std::size_t>(length));
  return out;
}

std::string cell(const nlohmann::ordered_json& value) {
  if (value.is_null()) return "<td></td>";
  if (value.is_string()) return fmt::format("<td class=\"t\">{}</td>", escaped(value.get<std::string>()));
  if (value.is_number_float()) return fmt::format("<td>{:.3g}</td>", value.get<double>());
  return fmt::format("<td>{}</td>", value.dump());
}

std::string element(const ReportTable& table) {
  std::string out = fmt::format("<table><caption>{}</caption>\n<tr>", escaped(table.title));
  for (const std::string& column : table.columns) out += fmt::format("<th>{}</th>", escaped(column));
  out += "</tr>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (const auto& value : row) out += cell(value);
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string csv_field(const nlohmann::ordered_json& value) {
  if (value.is_null()) return {};
  if (!value.is_string()) return value.dump();
  const std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

}  // namespace

std::string html(const Report& report) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title><style>{1}</style></head>\n"
      "<body><h1>{0}</h1>\n<table>\n",
      escaped(report.title), kStyle);
  for (const auto& [name, value] : report.facts) {
    out += fmt::format("<tr><td>{}</td><td class=\"t\">{}</td></tr>\n", escaped(name), escaped(value));
  }
  out += "</table>\n";
  for (const ReportSection& section : report.sections) {
    out += fmt::format("<h2>{}</h2>\n", escaped(section.title));
    for (const std::string& paragraph : section.paragraphs) out += fmt::format("<p>{}</p>\n", escaped(paragraph));
    for (const ReportTable& table : section.tables) out += element(table);
    for (const Plot& plot : section.plots) out += "<figure>" + svg(plot) + "</figure>\n";
    for (const ReportPicture& picture : section.pictures) {
      out += fmt::format(
          "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
          escaped(picture.caption), base64(picture.png));
    }
  }
  return out + "</body></html>\n";
}

nlohmann::ordered_json json(const Report& report) {
  nlohmann::ordered_json out = {{"title", report.title}};
  for (const auto& [name, value] : report.facts) out["facts"][name] = value;
  for (const ReportSection& section : report.sections) {
    for (const ReportTable& table : section.tables) {
      nlohmann::ordered_json& rows = out["tables"][table.name] = nlohmann::ordered_json::array();
      for (const auto& row : table.rows) {
        nlohmann::ordered_json object;
        for (std::size_t i = 0; i < row.size(); ++i) object[table.columns[i]] = row[i];
        rows.push_back(std::move(object));
      }
    }
  }
  return out;
}

std::string csv(const ReportTable& table) {
  std::string out;
  const auto add = [&out](const auto& values) {
    const char* separator = "";
    for (const auto& value : values) {
      out += separator;
      out += csv_field(value);
      separator = ",";
    }
    out += "\r\n";
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return out;
}

}  // namespace barkridge
