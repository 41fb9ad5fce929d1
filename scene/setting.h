#pragma once
// A key and its value as somebody wrote them, and where.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.h"

namespace barkridge {

/// A value of a kind that no key takes: a table, a date, a mixed array.
struct UnusableValue {
  std::string description;
};

/// An array of tables, whose own keys are settings too.
struct TableArray {
  std::size_t size;
};

using SettingValue =
    std::variant<UnusableValue, TableArray, bool, std::int64_t, double, std::string, std::vector<double>>;

struct Setting {
  /// Dotted; parts that are no bare TOML keys are quoted, and arrays of tables end in `[]`: `cut[].position`.
  std::string key;
  SettingValue value;
  SourceLocation key_place;
  SourceLocation value_place;
  /// Where the first character of a text's content stands, behind the opening quotes.
  int text_line = 1, text_column = 1;
  /// In which of an array's tables it stands; nothing outside of arrays, and in overrides for all of them.
  std::optional<std::size_t> element;
};

/// The settings of a TOML text, flat and in the order of the text. Tables appear themselves only when they are empty,
/// arrays of tables before what is in them; in tables of such an array there are no others.
/// Throws `InputError` for what is not TOML.
std::vector<Setting> read_settings(std::string_view text, const std::string& file);

/// A TOML value, or any other text as it stands: one setting, and more where it is an array of tables. `origin` is the
/// place in messages.
std::vector<Setting> read_override_settings(const std::string& key, const std::string& value,
                                            const std::string& origin);

/// A value for a message: `the text "abc"`, `-3`, `a table`.
std::string describe(const SettingValue& value);

}  // namespace barkridge
