#include "scene/key_suggestion.h"

#include <algorithm>
#include <numeric>

namespace barkridge {

namespace {

// Insertions, deletions and replacements that lead from one word to the other [Levenshtein 1966].
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(std::string_view written, const std::vector<std::string>& names) {
  constexpr std::size_t kLongestName = 100;
  if (written.size() > kLongestName) return {};
  std::string nearest;
  std::size_t smallest = std::max<std::size_t>(2, written.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t dot = name.rfind('.');
    const bool is_last_part = dot != std::string::npos && std::string_view(name).substr(dot + 1) == written;
    const std::size_t distance = is_last_part ? 0 : edit_distance(written, name);
    if (distance < smallest) {
      smallest = distance;
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace barkridge
