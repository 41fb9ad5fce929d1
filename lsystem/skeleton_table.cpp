#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/large_room.h"
#include "lsystem/characters.h"
#include "lsystem/skeleton.h"

namespace barkridge {

namespace {

constexpr std::string_view kHeader = "# barkridge skeleton 1";
constexpr std::string_view kMarkedHeader = "# barkridge skeleton 2";  // has lines of marks, too
constexpr std::size_t kFieldCount = 10;
constexpr std::array<const char*, kFieldCount> kFieldNames{"id", "parent", "x0", "y0", "z0",
                                                           "x1", "y1",     "z1", "r0", "r1"};

// Whole lines of a table. Stretches are read at the same time.
struct Stretch {
  std::string_view text;
  std::size_t first = 0;  // the first of its internodes
  std::size_t count = 0;  // how many there are, up to the first mistake
  std::exception_ptr mistake;
};

// What a line calls its internode, and the one that carries it.
struct Names {
  std::int64_t id, parent;
};

// Internodes by what the table calls them.
class IdTable {
 public:
  /// False if the id has been given already.
  bool add(std::int64_t id, InternodeId internode) {
    // Most tables count from 0: then an id needs no place in memory.
    if (others_.empty() && id == count_) {
      ++count_;
      return true;
    }
    return !(0 <= id && id < count_) && others_.emplace(id, internode).second;
  }
  InternodeId find(std::int64_t id) const {
    if (0 <= id && id < count_) return static_cast<InternodeId>(id);
    const auto found = others_.find(id);
    return found == others_.end() ? kNoInternode : found->second;
  }

 private:
  std::int64_t count_ = 0;  // ids below are the numbers of their internodes
  std::unordered_map<std::int64_t, InternodeId> others_;
};

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Skeleton read() {
    read_header();
    std::vector<Stretch> stretches = cut();
    tbb::parallel_for_each(stretches, [this](Stretch& stretch) {
      for_each_row(stretch.text, [&](std::string_view) { return ++stretch.count > 0; });
    });
    std::size_t count = 0;
    for (Stretch& stretch : stretches) {
      stretch.first = count;
      count += stretch.count;
    }
    if (count > static_cast<std::size_t>(std::numeric_limits<InternodeId>::max())) {
      throw LimitError(fmt::format("{}: a skeleton has at most 2147483647 internodes", file_));
    }
    resize_large(skeleton_.internodes, count);
    resize_large(names_, count);
    tbb::parallel_for_each(stretches, [&](Stretch& stretch) { read_rows(stretch); });
    for (const Stretch& stretch : stretches) {
      link(stretch);
      if (stretch.mistake) std::rethrow_exception(stretch.mistake);
    }
    if (has_marks_) read_marks();
    set_orders();
    return without_zero_lengths(std::move(skeleton_));
  }

 private:
  using Fields = std::array<std::string_view, kFieldCount>;

  [[noreturn]] void fail(const char* where, const std::string& message) const {
    throw InputError(locate(text_, static_cast<std::size_t>(where - text_.data()), file_), message);
  }

  void read_header() {
    const std::string_view line = text_.substr(0, text_.find('\n'));
    has_marks_ = trim(line) == kMarkedHeader;
    if (trim(line) == kHeader || has_marks_) return;
    const bool other_version = line.starts_with(kHeader.substr(0, kHeader.size() - 1));
    fail(line.data(), other_version ? "this version of the skeleton table is not known; only versions 1 and 2 are"
                                    : fmt::format("expected `{}` in the first line", kHeader));
  }

  // The lines after the header.
  std::vector<Stretch> cut() const {
    constexpr std::size_t kBytes = std::size_t{1} << 17;
    std::vector<Stretch> stretches;
    for (std::size_t start = after_line(0); start < text_.size();) {
      const std::size_t end = after_line(start + kBytes);
      stretches.push_back({text_.substr(start, end - start), 0, 0, nullptr});
      start = end;
    }
    return stretches;
  }

  // Where the line after the one of a place begins.
  std::size_t after_line(std::size_t place) const {
    const std::size_t newline = text_.find('\n', place);
    return newline == std::string_view::npos ? text_.size() : newline + 1;
  }

  bool is_mark(std::string_view content) const { return has_marks_ && 'a' <= content[0] && content[0] <= 'z'; }

  // Calls `work(line)` for every line that is an internode's, until it returns false.
  template <typename Work>
  void for_each_row(std::string_view lines, Work work) const {
    while (!lines.empty()) {
      const std::size_t end = std::min(lines.find('\n'), lines.size());
      const std::string_view line = lines.substr(0, end);
      const std::string_view content = trim(line);
      if (!content.empty() && content[0] != '#' && !is_mark(content) && !work(line)) return;
      lines.remove_prefix(std::min(end + 1, lines.size()));
    }
  }

  void read_rows(Stretch& stretch) {
    std::size_t row = stretch.first;
    try {
      for_each_row(stretch.text, [&](std::string_view line) {
        read_row(split(line), row);
        return ++row > 0;
      });
    } catch (const InputError&) {
      stretch.mistake = std::current_exception();
      stretch.count = row - stretch.first;
    }
  }

  Fields split(std::string_view line) const {
    Fields fields;
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
    return fields;
  }

  static std::size_t trim_end(std::string_view line) {
    std::size_t end = line.size();
    while (end > 0 && is_space(line[end - 1])) --end;
    return end;
  }

  void read_row(const Fields& fields, std::size_t row) {
    std::array<double, kFieldCount> numbers{};
    for (std::size_t i = 2; i < kFieldCount; ++i) numbers[i] = number(fields[i], kFieldNames[i]);
    for (std::size_t i = 8; i < kFieldCount; ++i) {
      if (numbers[i] <= 0) {
        fail(fields[i].data(), numbers[i] == 0 ? "the radius is zero" : "the radius is negative");
      }
    }
    Internode& internode = skeleton_.internodes[row];
    internode.base = {numbers[2], numbers[3], numbers[4]};
    internode.tip = {numbers[5], numbers[6], numbers[7]};
    internode.base_radius = numbers[8];
    internode.tip_radius = numbers[9];
    Names& names = names_[row];
    names.id = integer(fields[0], "id");
    if (names.id < 0) fail(fields[0].data(), "an internode's id must not be negative");
    names.parent = integer(fields[1], "parent");
  }

  // Finds the parents of a stretch's internodes.
  void link(const Stretch& stretch) {
    for (std::size_t row = stretch.first; row < stretch.first + stretch.count; ++row) {
      const auto [id, parent] = names_[row];
      if (parent != kNoInternode) {
        const InternodeId found = ids_.find(parent);
        if (found == kNoInternode) {
          fail(fields_of(stretch, row)[1].data(),
               fmt::format("the parent {} has not been listed; parents come before children", parent));
        }
        skeleton_.internodes[row].parent = found;
      }
      if (!ids_.add(id, static_cast<InternodeId>(row))) {
        fail(fields_of(stretch, row)[0].data(), fmt::format("the id {} is used twice", id));
      }
    }
  }

  Fields fields_of(const Stretch& stretch, std::size_t row) const {
    std::string_view found;
    std::size_t before = row - stretch.first;
    for_each_row(stretch.text, [&](std::string_view line) {
      found = line;
      return before-- > 0;
    });
    return split(found);
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

  // Marks may stand anywhere after the header. All internodes are known by now.
  void read_marks() {
    std::map<std::pair<double, double>, std::int32_t> ridges;  // by width and swelling
    for (std::size_t start = after_line(0); start < text_.size();) {
      const std::size_t end = after_line(start);
      const std::string_view content = trim(text_.substr(start, end - start));
      start = end;
      if (content.empty() || !is_mark(content)) continue;
      const std::vector<std::string_view> words = words_of(content);
      if (words[0] == "ridge") {
        const auto [internode, numbers] = mark<2>(words, {"width", "swelling"});
        const auto [known, is_new] =
            ridges.emplace(std::pair(numbers[0], numbers[1]), static_cast<std::int32_t>(skeleton_.ridges.size()));
        if (is_new) skeleton_.ridges.push_back({numbers[0], numbers[1]});
        skeleton_.internodes[static_cast<std::size_t>(internode)].ridge = known->second;
      } else if (words[0] == "cut") {
        add_cut(words);
      } else if (words[0] == "scar") {
        const auto [internode, numbers] = mark<3>(words, {"width", "depth", "stub"});
        const ScarShape shape{numbers[0], numbers[1], numbers[2]};
        try {
          check(shape);
        } catch (const InputError& error) {
          fail(content.data(), error.what());
        }
        skeleton_.scars.push_back({internode, shape});
      } else {
        fail(content.data(), fmt::format("expected ridge, cut or scar, not `{}`", words[0]));
      }
    }
    require_bare_ends();
  }

  void add_cut(const std::vector<std::string_view>& words) {
    const auto [internode, numbers] = mark<4>(words, {"nx", "ny", "nz", "splinters"});
    const Internode& a = skeleton_.internodes[static_cast<std::size_t>(internode)];
    const Vec3 normal(numbers[0], numbers[1], numbers[2]), axis = a.tip - a.base;
    constexpr double kRounding = 1e-6;
    const double least = std::cos(kSteepestCutDegrees * std::numbers::pi / 180) - kRounding;
    if (!(glm::length(normal) > 0) || glm::dot(normal, axis) < least * glm::length(normal) * glm::length(axis)) {
      fail(words[2].data(), fmt::format("a cut's normal is at most {} degrees from the axis", kSteepestCutDegrees));
    }
    if (!(0 <= numbers[3] && numbers[3] <= kLongestSplinters)) {
      fail(words[5].data(), fmt::format("expected splinters from 0 to {}", kLongestSplinters));
    }
    skeleton_.cut_ends.push_back({internode, glm::normalize(normal), numbers[3]});
  }

  // The internode that a mark names and the numbers that follow.
  template <std::size_t kCount>
  std::pair<InternodeId, std::array<double, kCount>> mark(const std::vector<std::string_view>& words,
                                                          const std::array<const char*, kCount>& names) const {
    if (words.size() != kCount + 2) {
      fail(words[0].data(),
           fmt::format("expected {} numbers after `{}`: id {}", kCount + 1, words[0], fmt::join(names, " ")));
    }
    const InternodeId internode = ids_.find(integer(words[1], "id"));
    if (internode == kNoInternode) fail(words[1].data(), fmt::format("no internode has the id {}", words[1]));
    std::array<double, kCount> numbers{};
    for (std::size_t i = 0; i < kCount; ++i) numbers[i] = number(words[i + 2], names[i]);
    return {internode, numbers};
  }

  static std::vector<std::string_view> words_of(std::string_view content) {
    std::vector<std::string_view> words;
    for (std::size_t i = 0; i < content.size();) {
      std::size_t end = i;
      while (end < content.size() && !is_space(content[end])) ++end;
      if (end > i) words.push_back(content.substr(i, end - i));
      i = end + 1;
    }
    return words;
  }

  // Cuts and scars go by their internodes, of which each has no children and no other such mark.
  void require_bare_ends() {
    const auto by_internode = [](const auto& a, const auto& b) { return a.internode < b.internode; };
    std::stable_sort(skeleton_.cut_ends.begin(), skeleton_.cut_ends.end(), by_internode);
    std::stable_sort(skeleton_.scars.begin(), skeleton_.scars.end(), by_internode);
    std::vector<bool> is_taken(skeleton_.internodes.size());
    for (const Internode& a : skeleton_.internodes) {
      if (a.parent != kNoInternode) is_taken[static_cast<std::size_t>(a.parent)] = true;
    }
    const auto take = [&](InternodeId internode, const char* what) {
      const auto i = static_cast<std::size_t>(internode);
      if (is_taken[i]) {
        throw InputError(fmt::format("{}: the {} of internode {}: expected one without children, cuts and scars", file_,
                                     what, names_[i].id));
      }
      is_taken[i] = true;
    };
    for (const CutEnd& end : skeleton_.cut_ends) take(end.internode, "cut");
    for (const Scar& scar : skeleton_.scars) take(scar.internode, "scar");
  }

  /// The thickest child, the first of equals, continues its parent's order; the others begin the next.
  void set_orders() {
    std::vector<Internode>& internodes = skeleton_.internodes;
    std::vector<InternodeId> thickest;
    reserve_large(thickest, internodes.size());
    thickest.resize(internodes.size(), kNoInternode);
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
  bool has_marks_ = false;
  Skeleton skeleton_;
  std::vector<Names> names_;  // by internode
  IdTable ids_;
};

}  // namespace

std::string write_skeleton_table(const Skeleton& skeleton) {
  fmt::memory_buffer text;
  const bool has_marks = !skeleton.cut_ends.empty() || !skeleton.scars.empty() ||
                         std::any_of(skeleton.internodes.begin(), skeleton.internodes.end(),
                                     [](const Internode& internode) { return internode.ridge != kNoRidge; });
  fmt::format_to(std::back_inserter(text), "{}\n", has_marks ? kMarkedHeader : kHeader);
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    const Internode& internode = skeleton.internodes[i];
    fmt::format_to(std::back_inserter(text), "{} {} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", i,
                   internode.parent, internode.base.x, internode.base.y, internode.base.z, internode.tip.x,
                   internode.tip.y, internode.tip.z, internode.base_radius, internode.tip_radius);
  }
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    if (skeleton.internodes[i].ridge == kNoRidge) continue;
    const Ridge& ridge = skeleton.ridges[static_cast<std::size_t>(skeleton.internodes[i].ridge)];
    fmt::format_to(std::back_inserter(text), "ridge {} {:.9g} {:.9g}\n", i, ridge.width, ridge.swelling);
  }
  for (const CutEnd& end : skeleton.cut_ends) {
    fmt::format_to(std::back_inserter(text), "cut {} {:.9g} {:.9g} {:.9g} {:.9g}\n", end.internode, end.normal.x,
                   end.normal.y, end.normal.z, end.splinters);
  }
  for (const Scar& scar : skeleton.scars) {
    fmt::format_to(std::back_inserter(text), "scar {} {:.9g} {:.9g} {:.9g}\n", scar.internode, scar.shape.width,
                   scar.shape.depth, scar.shape.stub);
  }
  return fmt::to_string(text);
}

Skeleton read_skeleton_table(std::string_view text, const std::string& file) { return TableReader(text, file).read(); }

}  // namespace barkridge
