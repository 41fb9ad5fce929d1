#pragma once
// A key and its value as somebody wrote them, and where.

#include <cstdint>
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

using SettingValue = std::variant<UnusableValue, bool, std::int64_t, double, std::string, std::vector<double>>;

struct Setting {
  std::string key;  ///< dotted; parts that are no bare TOML keys are quoted
  SettingValue value;
  SourceLocation key_place;
  SourceLocation value_place;
  /// Where the first character of a text's content stands, behind the opening quotes.
  int text_line = 1, text_column = 1;
};

/// The settings of a TOML text, flat and in the order of the text. Tables appear themselves only when they are empty.
/// In the keys of an array of tables, their number, from 0 on, follows the array's name. Throws `InputError` for what
/// is not TOML.
std::vector<Setting> read_settings(std::string_view text, const std::string& file);

/// A TOML value, or any other text as it stands. `origin` is the place in messages.
Setting read_single_setting(const std::string& key, const std::string& value, const std::string& origin);

/// A value for a message: `the text "abc"`, `-3`, `a table`.
std::string describe(const SettingValue& value);

}  // namespace barkridge
