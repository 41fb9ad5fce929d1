#include "lsystem/lst.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "lsystem/characters.h"

namespace barkridge {

namespace {

// Positions that differ by so little, relative to their size, differ by rounding.
constexpr double kRounding = 1e-12;

// The rotation by an angle about a unit axis. [Rodrigues]
Mat3 rotation(double angle, const Vec3& axis) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 turn(0);
  for (int column = 0; column < 3; ++column) {
    Vec3 unit(0);
    unit[column] = 1;
    turn[column] = c * unit + s * glm::cross(axis, unit) + (1 - c) * axis[column] * axis;
  }
  return turn;
}

struct Turtle {
  Vec3 position{0};
  Mat3 frame{1};
  InternodeId parent = kNoInternode;
  bool bracket_begins = false;  // and no cylinder has come since
};

class LstReader {
 public:
  LstReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Skeleton read() {
    read_header();
    for (skip_blanks(); place_ < text_.size(); skip_blanks()) run_operation();
    if (!stack_.empty()) fail(stack_.back().place, "this `SB` has no `EB`");
    return without_zero_lengths(std::move(skeleton_));
  }

 private:
  using Numbers = std::array<double, 4>;
  struct Remembered {
    Turtle turtle;
    std::size_t place;
  };

  [[noreturn]] void fail(std::size_t place, const std::string& message) const {
    throw InputError(locate(text_, place, file_), message);
  }

  // ---- Words.

  void skip_blanks() {
    while (place_ < text_.size() && is_space(text_[place_])) ++place_;
  }

  void read_header() {
    skip_blanks();
    const std::size_t start = place_;
    if (read_word() != "LST") fail(start, "expected `LST 0.1` in the first line");
    skip_blanks();
    const std::size_t version = place_;
    while (place_ < text_.size() && !is_space(text_[place_])) ++place_;
    if (text_.substr(version, place_ - version) != "0.1") fail(version, "only version 0.1 of the LST format is known");
  }

  std::string_view read_word() {
    const std::size_t start = place_;
    while (place_ < text_.size() && is_name_character(text_[place_])) ++place_;
    return text_.substr(start, place_ - start);
  }

  std::string describe_next() const {
    return place_ < text_.size() ? fmt::format("`{}`", text_[place_]) : std::string("the end of the file");
  }

  void expect(char c, const std::string& where) {
    skip_blanks();
    if (place_ == text_.size() || text_[place_] != c) {
      fail(place_, fmt::format("expected `{}` {}, not {}", c, where, describe_next()));
    }
    ++place_;
  }

  double read_number(const std::string& what) {
    skip_blanks();
    const std::size_t start = place_;
    if (place_ < text_.size() && text_[place_] == '+') ++place_;
    double number = 0;
    const auto [end, error] = std::from_chars(text_.data() + place_, text_.data() + text_.size(), number);
    if (error == std::errc::invalid_argument) {
      fail(place_, fmt::format("expected a number for {}, not {}", what, describe_next()));
    }
    if (error != std::errc() || !std::isfinite(number))
      fail(start, fmt::format("expected a finite number for {}", what));
    place_ = static_cast<std::size_t>(end - text_.data());
    return number;
  }

  template <std::size_t kCount>
  void read_arguments(std::string_view operation, const std::array<const char*, kCount>& names) {
    expect('(', fmt::format("after `{}`", operation));
    for (std::size_t i = 0; i < kCount; ++i) {
      if (i > 0) expect(',', fmt::format("after {} of `{}`", names[i - 1], operation));
      skip_blanks();
      places_[i] = place_;
      numbers_[i] = read_number(fmt::format("{} of `{}`", names[i], operation));
    }
    expect(')', fmt::format("at the end of `{}`", operation));
  }

  // ---- Operations.

  void run_operation() {
    const std::size_t start = place_;
    const std::string_view operation = read_word();
    if (operation == "SB") {
      read_arguments<0>(operation, {});
      stack_.push_back({turtle_, start});
      turtle_.bracket_begins = true;
    } else if (operation == "EB") {
      read_arguments<0>(operation, {});
      if (stack_.empty()) fail(start, "this `EB` has no `SB`");
      turtle_ = stack_.back().turtle;
      stack_.pop_back();
    } else if (operation == "MovRel3f") {
      read_arguments<3>(operation, {"x", "y", "z"});
      turtle_.position += turtle_.frame * Vec3(numbers_[0], numbers_[1], numbers_[2]);
      check_place(start);
    } else if (operation == "RotRel3f") {
      read_arguments<4>(operation, {"the angle", "x", "y", "z"});
      turn();
    } else if (operation == "Cylinder") {
      read_arguments<3>(operation, {"the start radius", "the end radius", "the length"});
      add_cylinder(start);
    } else {
      fail(start, fmt::format("expected SB, EB, MovRel3f, RotRel3f or Cylinder, not {}",
                              operation.empty() ? describe_next() : fmt::format("`{}`", operation)));
    }
  }

  void check_place(std::size_t start) const {
    const Vec3& p = turtle_.position;
    if (!std::isfinite(p.x + p.y + p.z)) fail(start, "this leads out of all finite places");
  }

  void turn() {
    // Divided first, so that no square overflows or vanishes.
    Vec3 axis(numbers_[1], numbers_[2], numbers_[3]);
    const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
    if (largest == 0) fail(places_[1], "the axis is zero: expected a direction");
    turtle_.frame = turtle_.frame * rotation(numbers_[0], glm::normalize(axis / largest));
  }

  void add_cylinder(std::size_t start) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (numbers_[i] <= 0) fail(places_[i], numbers_[i] == 0 ? "the radius is zero" : "the radius is negative");
    }
    if (numbers_[2] < 0) fail(places_[2], "the length is negative");
    std::vector<Internode>& internodes = skeleton_.internodes;
    if (internodes.size() == static_cast<std::size_t>(std::numeric_limits<InternodeId>::max())) {
      throw LimitError(locate(text_, start, file_), "a skeleton has at most 2147483647 internodes");
    }
    Internode internode;
    internode.base = turtle_.position;
    internode.parent = turtle_.parent;
    if (internode.parent != kNoInternode) {
      const Internode& parent = internodes[static_cast<std::size_t>(internode.parent)];
      internode.order = parent.order + (turtle_.bracket_begins ? 1 : 0);
      const double size = glm::length(parent.tip) + glm::distance(parent.base, parent.tip);
      if (glm::distance(internode.base, parent.tip) <= kRounding * size) internode.base = parent.tip;
    }
    internode.tip = internode.base + numbers_[2] * turtle_.frame[1];
    if (!std::isfinite(internode.tip.x + internode.tip.y + internode.tip.z)) {
      fail(start, "this leads out of all finite places");
    }
    internode.base_radius = numbers_[0];
    internode.tip_radius = numbers_[1];
    turtle_.parent = static_cast<InternodeId>(internodes.size());
    turtle_.bracket_begins = false;
    internodes.push_back(internode);
  }

  const std::string_view text_;
  const std::string& file_;
  std::size_t place_ = 0;
  Numbers numbers_{};                    // the current operation's arguments
  std::array<std::size_t, 4> places_{};  // and where they stand
  Turtle turtle_;
  std::vector<Remembered> stack_;
  Skeleton skeleton_;
};

}  // namespace

Skeleton read_lst(std::string_view text, const std::string& file) { return LstReader(text, file).read(); }

}  // namespace barkridge
