#include "scene/setting.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace barkridge {

namespace {

// toml++ frees nested tables by recursion, so the length of a dotted key is limited before it sees the text.
constexpr int kMaxKeyParts = 64;

bool is_bare(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }

// The end of the key part (bare or quoted) that starts at `i`; `i` itself if none does.
std::size_t key_part_end(std::string_view text, std::size_t i) {
  if (text[i] == '"' || text[i] == '\'') {
    const char quote = text[i];
    std::size_t end = i + 1;
    while (end < text.size() && text[end] != quote && text[end] != '\n') {
      end += quote == '"' && text[end] == '\\' && end + 1 < text.size() ? 2 : 1;
    }
    return end < text.size() && text[end] == quote ? end + 1 : i;
  }
  while (i < text.size() && is_bare(text[i])) ++i;
  return i;
}

void check_key_depth(std::string_view text, const std::string& file) {
  const auto past_blanks = [&](std::size_t i) {
    while (i < text.size() && (text[i] == ' ' || text[i] == '\t')) ++i;
    return i;
  };
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t start = i;
    std::size_t end = key_part_end(text, i);
    if (end == i) {
      ++i;
      continue;
    }
    for (int parts = 1;; ++parts) {
      if (parts > kMaxKeyParts) {
        throw InputError(locate(text, start, file), fmt::format("a key of more than {} parts", kMaxKeyParts));
      }
      i = past_blanks(end);
      if (i >= text.size() || text[i] != '.') break;
      i = past_blanks(i + 1);
      end = i < text.size() ? key_part_end(text, i) : i;
      if (end == i) break;
    }
  }
}

// Lines of a text by number, for places.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file) : text_(text), file_(file) {
    starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') starts_.push_back(i + 1);
    }
  }

  // toml++ counts code points in a line, our places count bytes.
  std::size_t offset(const toml::source_position& position) const {
    if (position.line == 0) return 0;
    std::size_t i = starts_[std::min<std::size_t>(position.line - 1, starts_.size() - 1)];
    for (std::uint32_t column = 1; column < position.column && i < text_.size() && text_[i] != '\n'; ++column) {
      ++i;
      while (i < text_.size() && (static_cast<unsigned char>(text_[i]) & 0xC0) == 0x80) ++i;
    }
    return i;
  }

  SourceLocation place(const toml::source_position& position) const { return locate(text_, offset(position), file_); }

  // The place of a text's content, given that of its opening quotes.
  SourceLocation content_place(const toml::source_position& position) const {
    std::size_t i = offset(position);
    const std::string_view opening = text_.substr(i, 3);
    if (opening == "'''" || opening == "\"\"\"") {
      i += 3;
      if (text_.substr(i, 2) == "\r\n") ++i;
      if (i < text_.size() && text_[i] == '\n') ++i;
    } else {
      ++i;
    }
    return locate(text_, i, file_);
  }

 private:
  std::string_view text_;
  const std::string& file_;
  std::vector<std::size_t> starts_;
};

std::optional<std::vector<double>> numbers_of(const toml::array& array) {
  std::vector<double> numbers;
  for (const toml::node& element : array) {
    if (!element.is_number()) return std::nullopt;
    numbers.push_back(*element.value<double>());
  }
  return numbers;
}

SettingValue value_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::boolean:
      return node.as_boolean()->get();
    case toml::node_type::integer:
      return node.as_integer()->get();
    case toml::node_type::floating_point:
      return node.as_floating_point()->get();
    case toml::node_type::string:
      return node.as_string()->get();
    case toml::node_type::array:
      if (auto numbers = numbers_of(*node.as_array())) return std::move(*numbers);
      return UnusableValue{"an array of other things than numbers"};
    case toml::node_type::table:
      return UnusableValue{"a table"};
    default:
      return UnusableValue{"a date or time"};
  }
}

std::string quoted_unless_bare(std::string_view part) {
  if (!part.empty() && std::all_of(part.begin(), part.end(), is_bare)) return std::string(part);
  return fmt::format("\"{}\"", part);
}

// Recursion is as deep as keys have parts: see kMaxKeyParts.
void flatten(const toml::table& table, const std::string& prefix, const Lines& lines, std::vector<Setting>& settings) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + quoted_unless_bare(key.str());
    if (node.is_table() && !node.as_table()->empty()) {
      flatten(*node.as_table(), name + '.', lines, settings);
      continue;
    }
    if (node.is_array_of_tables()) {
      const toml::array& tables = *node.as_array();
      for (std::size_t i = 0; i < tables.size(); ++i) {
        flatten(*tables[i].as_table(), fmt::format("{}.{}.", name, i), lines, settings);
      }
      continue;
    }
    const toml::source_position begin = node.source().begin;
    const SourceLocation content = lines.content_place(begin);
    settings.push_back(
        {name, value_of(node), lines.place(key.source().begin), lines.place(begin), content.line, content.column});
  }
}

toml::table parse(std::string_view text, const std::string& file, const Lines& lines) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(lines.place(error.source().begin), std::string(error.description()));
  }
}

}  // namespace

std::vector<Setting> read_settings(std::string_view text, const std::string& file) {
  check_key_depth(text, file);
  const Lines lines(text, file);
  std::vector<Setting> settings;
  flatten(parse(text, file, lines), "", lines, settings);
  std::sort(settings.begin(), settings.end(), [](const Setting& a, const Setting& b) {
    return std::pair(a.key_place.line, a.key_place.column) < std::pair(b.key_place.line, b.key_place.column);
  });
  return settings;
}

Setting read_single_setting(const std::string& key, const std::string& value, const std::string& origin) {
  Setting setting;
  setting.value = value;
  try {
    const std::vector<Setting> settings = read_settings("value = " + value, origin);
    if (settings.size() == 1 && settings[0].key == "value") setting.value = settings[0].value;
  } catch (const InputError&) {
    // A bare word is a text.
  }
  setting.key = key;
  setting.key_place = setting.value_place = SourceLocation{origin, 0, 0, ""};
  return setting;
}

std::string describe(const SettingValue& value) {
  struct Describer {
    std::string operator()(const UnusableValue& v) const { return v.description; }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return fmt::format("{:#}", v); }
    std::string operator()(const std::string& v) const {
      if (v.size() > 40 || v.find('\n') != std::string::npos) return "a long text";
      return fmt::format("the text \"{}\"", v);
    }
    std::string operator()(const std::vector<double>& v) const {
      if (v.size() > 8) return fmt::format("an array of {} numbers", v.size());
      return fmt::format("[{}]", fmt::join(v, ", "));
    }
  };
  return std::visit(Describer{}, value);
}

}  // namespace barkridge
