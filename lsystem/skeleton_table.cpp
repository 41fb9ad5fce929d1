#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>

#include "base/error.h"
#include "lsystem/characters.h"
#include "lsystem/skeleton.h"

namespace barkridge {

namespace {

constexpr std::string_view kHeader = "# barkridge skeleton 1";
constexpr std::size_t kFieldCount = 10;
constexpr std::array<const char*, kFieldCount> kFieldNames{"id", "parent", "x0", "y0", "z0",
                                                           "x1", "y1",     "z1", "r0", "r1"};

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Skeleton read() {
    read_header();
    while (line_start_ < text_.size()) {
      const std::string_view line = next_line();
      const std::string_view content = trim(line);
      if (!content.empty() && content[0] != '#') read_internode(line);
    }
    set_orders();
    return without_zero_lengths(std::move(skeleton_));
  }

 private:
  [[noreturn]] void fail(const char* where, const std::string& message) const {
    throw InputError(locate(text_, static_cast<std::size_t>(where - text_.data()), file_), message);
  }

  std::string_view next_line() {
    const std::size_t end = std::min(text_.find('\n', line_start_), text_.size());
    const std::string_view line = text_.substr(line_start_, end - line_start_);
    line_start_ = end + 1;
    return line;
  }

  void read_header() {
    const std::string_view line = next_line();
    if (trim(line) == kHeader) return;
    const bool other_version = line.starts_with(kHeader.substr(0, kHeader.size() - 1));
    fail(line.data(), other_version ? "this version of the skeleton table is not known; only version 1 is"
                                    : fmt::format("expected `{}` in the first line", kHeader));
  }

  void read_internode(std::string_view line) {
    std::array<std::string_view, kFieldCount> fields;
    std::size_t count = 0;
    for (std::size_t i = 0; i < line.size();) {
      std::size_t end = i;
      while (end < line.size() && !is_space(line[end])) ++end;
      if (end > i) {
        if (count == kFieldCount) fail(line.data() + i, fmt::format("expected {} fields, not more", kFieldCount));
        fields[count++] = line.substr(i, end - i);
      }
      i = end + 1;
    }
    if (count < kFieldCount) {
      fail(line.data() + trim_end(line),
           fmt::format("expected {} fields, `{}` and what follows are missing", kFieldCount, kFieldNames[count]));
    }
    std::array<double, kFieldCount> numbers{};
    for (std::size_t i = 2; i < kFieldCount; ++i) numbers[i] = number(fields[i], kFieldNames[i]);
    for (std::size_t i = 8; i < kFieldCount; ++i) {
      if (numbers[i] <= 0) {
        fail(fields[i].data(), numbers[i] == 0 ? "the radius is zero" : "the radius is negative");
      }
    }
    Internode internode;
    internode.base = {numbers[2], numbers[3], numbers[4]};
    internode.tip = {numbers[5], numbers[6], numbers[7]};
    internode.base_radius = numbers[8];
    internode.tip_radius = numbers[9];
    add(internode, fields[0], fields[1]);
  }

  void add(Internode internode, std::string_view id_field, std::string_view parent_field) {
    const std::int64_t id = integer(id_field, "id");
    if (id < 0) fail(id_field.data(), "an internode's id must not be negative");
    const std::int64_t parent = integer(parent_field, "parent");
    if (parent != kNoInternode) {
      const auto found = ids_.find(parent);
      if (found == ids_.end()) {
        fail(parent_field.data(),
             fmt::format("the parent {} has not been listed; parents come before children", parent));
      }
      internode.parent = found->second;
    }
    if (skeleton_.internodes.size() >= static_cast<std::size_t>(std::numeric_limits<InternodeId>::max())) {
      throw LimitError(fmt::format("{}: a skeleton has at most 2147483647 internodes", file_));
    }
    const auto index = static_cast<InternodeId>(skeleton_.internodes.size());
    if (!ids_.emplace(id, index).second) fail(id_field.data(), fmt::format("the id {} is used twice", id));
    skeleton_.internodes.push_back(internode);
  }

  static std::size_t trim_end(std::string_view line) {
    std::size_t end = line.size();
    while (end > 0 && is_space(line[end - 1])) --end;
    return end;
  }

  double number(std::string_view field, const char* name) const {
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error == std::errc::invalid_argument || end != field.data() + field.size()) {
      fail(field.data(), fmt::format("expected a number for {}, not `{}`", name, field));
    }
    if (error == std::errc::result_out_of_range) fail(field.data(), fmt::format("{} is out of range", name));
    if (std::isnan(value)) fail(field.data(), fmt::format("{} is not a number (nan)", name));
    if (std::isinf(value)) fail(field.data(), fmt::format("{} is infinite", name));
    return value;
  }

  std::int64_t integer(std::string_view field, const char* name) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size()) {
      fail(field.data(), fmt::format("expected an integer for {}, not `{}`", name, field));
    }
    return value;
  }

  /// The thickest child, the first of equals, continues its parent's order; the others begin the next.
  void set_orders() {
    std::vector<Internode>& internodes = skeleton_.internodes;
    std::vector<InternodeId> thickest(internodes.size(), kNoInternode);
    for (std::size_t i = 0; i < internodes.size(); ++i) {
      if (internodes[i].parent == kNoInternode) continue;
      InternodeId& best = thickest[static_cast<std::size_t>(internodes[i].parent)];
      if (best == kNoInternode || internodes[i].base_radius > internodes[static_cast<std::size_t>(best)].base_radius) {
        best = static_cast<InternodeId>(i);
      }
    }
    for (std::size_t i = 0; i < internodes.size(); ++i) {
      if (internodes[i].parent == kNoInternode) continue;
      const auto parent = static_cast<std::size_t>(internodes[i].parent);
      internodes[i].order = internodes[parent].order + (thickest[parent] != static_cast<InternodeId>(i));
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t line_start_ = 0;
  std::unordered_map<std::int64_t, InternodeId> ids_;
  Skeleton skeleton_;
};

}  // namespace

std::string write_skeleton_table(const Skeleton& skeleton) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}\n", kHeader);
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    const Internode& internode = skeleton.internodes[i];
    fmt::format_to(std::back_inserter(text), "{} {} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", i,
                   internode.parent, internode.base.x, internode.base.y, internode.base.z, internode.tip.x,
                   internode.tip.y, internode.tip.z, internode.base_radius, internode.tip_radius);
  }
  return fmt::to_string(text);
}

Skeleton read_skeleton_table(std::string_view text, const std::string& file) { return TableReader(text, file).read(); }

}  // namespace barkridge
