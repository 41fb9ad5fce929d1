#include "lsystem/turtle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsystem/homomorphism.h"
#include "lsystem/machine.h"
#include "lsystem/prune.h"

namespace barkridge {

namespace {

constexpr double kMinWidth = 1e-7;
constexpr double kLeastLength = 1e-6;  // of what has just appeared
constexpr std::size_t kModulesPerReport = 1 << 16;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::shared_ptr<const MachineState> state_at(const MachineState& state, double time) {
  auto changed = std::make_shared<MachineState>(state);
  changed->time = time;
  return changed;
}

/// Turns `a` towards `b` and `b` away from `a`.
void turn(Vec3& a, Vec3& b, double sine, double cosine) {
  const Vec3 turned = cosine * a + sine * b;
  b = cosine * b - sine * a;
  a = turned;
}

/// What brackets save.
struct State {
  Vec3 position{0};
  Vec3 heading{0, 1, 0};
  Vec3 left{-1, 0, 0};
  Vec3 down{0, 0, -1};  ///< left x heading; cpfg calls it up
  /// Heading and `down` at the last segment's end, which `@R` transports `down` from.
  Vec3 last_heading{0, 1, 0};
  Vec3 last_down{0, 0, -1};
  double width = 1;
  double scale = 1;
  int color = 0;
  std::int32_t ridge = kNoRidge;         ///< index in the skeleton's ridges
  InternodeId internode = kNoInternode;  ///< the last on this branch or before it
  bool begins_branch = false;            ///< no segment has been drawn since the bracket opened
  std::size_t opened_at = 0;             ///< the module that opened the bracket
};

class Turtle {
 public:
  Turtle(const Word& word, const Grammar* grammar, const TurtleOptions& options)
      : word_(word),
        grammar_(grammar),
        options_(options),
        modules_(word, grammar, options.max_modules, options.notify) {
    now_.width = options.line_width * options.step;
    now_.scale = options.initial_scale;
    now_.color = options.color;
    sub_lsystem_scales_.push_back(options.initial_scale);
  }

  Skeleton run() {
    std::size_t next_report = 0;
    while (modules_.next()) {
      record_cuts(modules_.origin());
      obey();
      if (modules_.origin() < next_report) continue;
      report(options_.progress, static_cast<double>(modules_.origin()) / static_cast<double>(word_.modules.size()));
      next_report = modules_.origin() + kModulesPerReport;
    }
    record_cuts(word_.modules.size());
    end_segment();
    if (!stack_.empty()) {
      throw InputError(fmt::format("{}: this `[` lacks its `]`", describe(now_.opened_at)));
    }
    report(options_.progress, 1);
    sort_ends();
    thicken(skeleton_, options_.growth);
    return std::move(skeleton_);
  }

 private:
  // Errors.

  std::string describe(std::size_t origin) const {
    Word single;
    append_copy(word_, origin, single);
    return fmt::format("module {} of the word, `{}`", origin + 1, to_string(single));
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(describe(modules_.origin()) + ": " + what); }
  void note_once(const std::string& message) {
    if (noted_.insert(message).second) notify(options_.notify, message);
  }

  // Commands.

  bool has_value() const { return !modules_.parameters().empty(); }
  double value(std::size_t index = 0) const { return modules_.parameters()[index]; }
  double value_or(double otherwise) const { return has_value() ? value() : otherwise; }

  void obey() {
    switch (modules_.module().symbol) {
      case 'F':
      case 'G':
        return draw_segment();
      case 'f':
      case 'g':
        end_segment();
        now_.position += step_length() * now_.heading;
        return;
      case '+':
        return rotate(now_.heading, now_.left, opened());
      case '-':
        return rotate(now_.heading, now_.left, -opened());
      case '&':
        return rotate(now_.heading, now_.down, opened());
      case '^':
        return rotate(now_.heading, now_.down, -opened());
      case '/':
        return rotate(now_.left, now_.down, 1);
      case '\\':
        return rotate(now_.left, now_.down, -1);
      case '|':
        return turn(now_.heading, now_.left, 0, -1);
      case '!':
        return set_width(-1);
      case '#':
        return set_width(1);
      case ';':
        return set_color(1);
      case ',':
        return set_color(-1);
      case '[':
        return open_bracket();
      case ']':
        return close_bracket();
      case '@':
        return obey_at();
      case '~':
        return place_surface();
      case '?':
        return enter_sub_lsystem();
      case '$':
        return leave_sub_lsystem();
      case '{':
      case '}':
      case '.':
        end_segment();
        note_once("polygons (`{`, `.`, `}`) are not drawn yet");
        return;
      case '_':
        return note_once("tropisms (`_`) have no effect yet");
      default:
        return;  // not a command; `%` has done its work in the derivation
    }
  }

  // What the present module has reached by its age.

  double grown(double steps) const { return grown_part(modules_.module().birth_step, steps, options_.growth); }
  double opened() const { return grown(options_.growth.opening_steps); }
  double grown_length(double length) const {
    const double part = grown(options_.growth.elongation_steps);
    return part < kLeastLength ? 0 : part * length;
  }

  double step_length() const { return grown_length(value_or(options_.step) * now_.scale); }

  void rotate(Vec3& a, Vec3& b, double factor) {
    const double angle = factor * radians(value_or(options_.angle_increment_degrees));
    turn(a, b, std::sin(angle), std::cos(angle));
  }

  void set_width(double sign) {
    if (has_value()) {
      const double width = value() * now_.scale;
      now_.width = width > 0 ? std::max(width, kMinWidth) : width;
    } else {
      now_.width = std::max(now_.width + sign * options_.line_width_increment * now_.scale, kMinWidth);
    }
  }

  void set_color(int sign) {
    const double color = has_value() ? value() : now_.color + sign * options_.color_increment;
    const double wrapped = std::fmod(std::trunc(color), 256.0);
    now_.color = static_cast<int>(wrapped < 0 ? wrapped + 256 : wrapped);
  }

  void draw_segment() {
    end_segment();
    const Vec3 base = now_.position;
    now_.position += step_length() * now_.heading;
    now_.last_heading = now_.heading;
    now_.last_down = now_.down;
    if (!finite(now_.position)) fail("the turtle is infinitely far away here");
    if (now_.position == base) {
      ++skeleton_.dropped_internodes;
      return;
    }
    add_internode(base, now_.position);
    segment_is_open_ = true;
  }

  void add_internode(const Vec3& base, const Vec3& tip) {
    if (!std::isfinite(now_.width)) fail("a segment begins with infinite width here");
    if (now_.width == 0) fail("a segment begins with width 0 here");
    if (now_.width < 0) fail(fmt::format("a segment begins with the negative width {:g} here", now_.width));
    if (skeleton_.internodes.size() >= std::min<std::size_t>(options_.max_internodes, max_id())) {
      throw LimitError(fmt::format("the skeleton would have more than {} internodes", skeleton_.internodes.size()));
    }
    Internode internode;
    internode.base = base;
    internode.tip = tip;
    internode.base_radius = now_.width / 2;
    internode.tip_radius = internode.base_radius;
    internode.parent = now_.internode;
    if (now_.internode != kNoInternode) {
      internode.order = skeleton_.internodes[static_cast<std::size_t>(now_.internode)].order + now_.begins_branch;
    }
    internode.birth_step = modules_.module().birth_step;
    internode.ridge = now_.ridge;
    now_.internode = static_cast<InternodeId>(skeleton_.internodes.size());
    now_.begins_branch = false;
    skeleton_.internodes.push_back(internode);
  }

  static std::size_t max_id() { return static_cast<std::size_t>(std::numeric_limits<InternodeId>::max()); }

  /// The width at the next command that ends a segment is that of its tip.
  void end_segment() {
    if (!segment_is_open_) return;
    segment_is_open_ = false;
    if (!options_.tapered_lines) return;
    if (!std::isfinite(now_.width)) fail("a segment ends with infinite width here");
    if (now_.width < 0) fail(fmt::format("a segment ends with the negative width {:g} here", now_.width));
    skeleton_.internodes.back().tip_radius = std::max(now_.width, kMinWidth) / 2;
  }

  void open_bracket() {
    end_segment();
    if (stack_.size() >= options_.max_bracket_depth) {
      throw LimitError(fmt::format("brackets are nested more than {} deep", options_.max_bracket_depth));
    }
    stack_.push_back(now_);
    now_.begins_branch = true;
    now_.opened_at = modules_.origin();
  }

  void close_bracket() {
    end_segment();
    if (stack_.empty()) fail("this `]` lacks its `[`");
    now_ = stack_.back();
    stack_.pop_back();
  }

  void place_surface() {
    end_segment();
    const Word::Module* const surface = modules_.operand();
    if (surface == nullptr) return;
    modules_.take_operand();
    add_organ(std::string("~") + surface->symbol, value_or(1) * now_.scale);
  }

  void add_organ(std::string kind, double size) {
    if (!finite(now_.position)) fail("the turtle is infinitely far away here");
    if (!std::isfinite(size)) fail("something of infinite size is drawn here");
    const double grown_size = grown_length(size);
    if (grown_size == 0 && size != 0) return;
    if (skeleton_.organs.size() >= options_.max_internodes) {
      throw LimitError(fmt::format("the skeleton would have more than {} organs", options_.max_internodes));
    }
    skeleton_.organs.push_back(
        {std::move(kind), now_.position, now_.heading, now_.left, -now_.down, grown_size, now_.color, now_.internode});
  }

  // What was shed.

  /// Of the cuts before the module at `origin`, those right before it; the turtle passed over the others.
  void record_cuts(std::size_t origin) {
    for (; next_cut_ < word_.cuts.size() && word_.cuts[next_cut_].position <= origin; ++next_cut_) {
      if (word_.cuts[next_cut_].position == origin) record(word_.cuts[next_cut_]);
    }
  }

  void record(const Word::Cut& cut) {
    const double now = options_.growth.time.value_or(word_.state->time), then = birth_time(cut.step);
    TurtleOptions options = options_;
    options.progress = {};
    options.growth.time = then;
    Word branch = *cut.branch;
    branch.state = state_at(*word_.state, then);
    Turtle turtle(branch, grammar_, options);
    turtle.now_ = now_;
    turtle.now_.internode = kNoInternode;
    for (const Internode& internode : turtle.run().internodes) {
      if (internode.parent != kNoInternode) continue;
      skeleton_.shed_branches.push_back({now_.internode, internode.base, glm::normalize(internode.tip - internode.base),
                                         internode.base_radius, now - then});
    }
  }

  // Sub-L-systems have a scale of their own, which replaces the turtle's.

  void enter_sub_lsystem() {
    if (!has_value()) {
      if (modules_.operand() != nullptr) modules_.take_operand();  // a query's letter
      return;
    }
    const double outer = sub_lsystem_scales_.back();
    sub_lsystem_scales_.push_back(modules_.parameters().size() > 1 ? outer * value(1) : outer);
    change_sub_lsystem_scale(outer, sub_lsystem_scales_.back());
  }

  void leave_sub_lsystem() {
    if (sub_lsystem_scales_.size() == 1) return;
    const double inner = sub_lsystem_scales_.back();
    sub_lsystem_scales_.pop_back();
    change_sub_lsystem_scale(inner, sub_lsystem_scales_.back());
  }

  void change_sub_lsystem_scale(double from, double to) {
    now_.scale = to;
    now_.width = now_.width * to / from;
  }

  // Commands of two and three letters. An unknown one leaves its letters to be commands themselves.

  void obey_at() {
    end_segment();
    const Word::Module* const letter = modules_.operand();
    if (letter == nullptr) return;
    const char command = letter->symbol;
    if (std::string_view("PTGmb").find(command) != std::string_view::npos ||
        (command == 'D' && letter->parameter_count == 0)) {
      return obey_at_with_suffix(command, letter->parameter_count > 0);
    }
    if (std::string_view(",;ocOvRMWLSDIJ#!Kk").find(command) == std::string_view::npos) return;
    modules_.take_operand();
    switch (command) {
      case 'o':
      case 'c':
      case 'O':
        return add_organ(std::string("@") + command, has_value() ? value() * now_.scale : now_.width);
      case 'v':
        return roll_to_vertical();
      case 'R':
        return set_heading();
      case 'M':
        return set_position();
      case 'W':
        return set_ridge();
      case 'D':
        now_.scale = value();
        return;
      case 'K':
        return cut_segment();
      case 'k':
        return leave_scar();
      default:
        return;  // colours of the back side, labels, contours and the like
    }
  }

  // Marks of missing organs, which cpfg does not know.

  double value_in(std::size_t index, double otherwise, double lo, double hi, const char* what) const {
    if (modules_.parameters().size() <= index) return otherwise;
    const double x = value(index);
    if (!(lo <= x && x <= hi)) fail(fmt::format("{} {:g} is outside its range, {:g} to {:g}", what, x, lo, hi));
    return x;
  }

  void cut_segment() {
    const double tilt = value_in(0, 0, -kSteepestCutDegrees, kSteepestCutDegrees, "the cut's tilt");
    const double splinters = value_in(1, 0, 0, kLongestSplinters, "the splinters' height");
    if (now_.internode == kNoInternode) fail("there is no segment to cut here");
    const Internode& cut = skeleton_.internodes[static_cast<std::size_t>(now_.internode)];
    const Vec3 axis = glm::normalize(cut.tip - cut.base);
    skeleton_.cut_ends.push_back({now_.internode, tilted_away(axis, now_.last_down, tilt), splinters});
    modules_.skip_branch();
  }

  void leave_scar() {
    ScarShape shape;
    shape.width = value_in(0, shape.width, 1e-3, 1e3, "the scar's width");
    shape.depth = value_in(1, shape.depth, 0, 1e3, "the scar's depth");
    shape.stub = value_in(2, shape.stub, 0, 1, "the stub's height");
    if (now_.internode == kNoInternode) fail("there is no segment to leave a scar on here");
    const double carrier_radius = skeleton_.internodes[static_cast<std::size_t>(now_.internode)].tip_radius;
    add_internode(now_.position, now_.position + stub_length(carrier_radius, now_.width / 2) * now_.heading);
    skeleton_.scars.push_back({now_.internode, shape});
    modules_.skip_branch();
  }

  // Branches are marked before what carries them.
  void sort_ends() {
    const auto by_internode = [](const auto& a, const auto& b) { return a.internode < b.internode; };
    const auto same = [](const auto& a, const auto& b) { return a.internode == b.internode; };
    std::vector<CutEnd>& ends = skeleton_.cut_ends;
    std::stable_sort(ends.begin(), ends.end(), by_internode);
    ends.erase(std::unique(ends.begin(), ends.end(), same), ends.end());
    std::sort(skeleton_.scars.begin(), skeleton_.scars.end(), by_internode);
  }

  void obey_at_with_suffix(char command, bool has_parameters) {
    // With parameters on its first letter, such a command has no second one, and does nothing.
    const Word::Module* const second = modules_.operand(1);
    const char suffix = has_parameters || second == nullptr ? '\0' : second->symbol;
    const std::string_view suffixes = command == 'P'   ? "SCD"
                                      : command == 'T' ? "xidspf"
                                      : command == 'G' ? "scetr"
                                      : command == 'm' ? "oc"
                                      : command == 'D' ? "id"
                                                       : "oc";
    if (suffix == '\0' || suffixes.find(suffix) == std::string_view::npos) return;
    modules_.take_operand();
    modules_.take_operand();
    if (command == 'D') return multiply_scale(suffix == 'd');
    if (command == 'm' && suffix == 'c' && value_or(0) == 1) modules_.skip_branch();
    if (command == 'G') note_once("generalised cylinders (`@G`) are not drawn yet");
    if (command == 'P') note_once("surface patches (`@P`) are not drawn yet");
    if (command == 'b') note_once("rings (`@b`) are not drawn yet");
    if (command == 'T' && suffix != 'x') note_once("tropisms (`@T`) have no effect yet");
  }

  void multiply_scale(bool divide) {
    const double factor = value_or(options_.scale_multiplier);
    if (factor == 0) fail("a scale cannot be multiplied or divided by 0");
    now_.scale = divide ? now_.scale / factor : now_.scale * factor;
  }

  void roll_to_vertical() {
    const Vec3 across = glm::cross(Vec3(0, 1, 0), now_.heading);
    const double length = glm::length(across);
    if (std::fabs(now_.heading.y) >= 1 || length == 0) return;
    now_.left = across / length;
    now_.down = glm::cross(now_.left, now_.heading);
  }

  void set_heading() {
    const std::span<const float> values = modules_.parameters();
    if (values.size() < 2) return;
    const Vec3 heading(values[0], values[1], values.size() > 2 ? values[2] : 0);
    const double length = glm::length(heading);
    now_.heading = length > 0 ? heading / length : Vec3(0, 1, 0);
    if (values.size() >= 6) {
      const Vec3 down(values[3], values[4], values[5]);
      if (glm::length(down) > 0 && glm::dot(down, now_.heading) == 0) {
        now_.down = glm::normalize(down);
        now_.left = glm::cross(now_.heading, now_.down);
        return;
      }
    }
    transport_frame();
  }

  /// Turns the frame of the last segment, without twist, to the present heading.
  void transport_frame() {
    const Vec3 axis = glm::cross(now_.last_heading, now_.heading);
    const double sine = glm::length(axis);
    if (sine > 1e-6) {
      const Vec3 unit = axis / sine;
      const double cosine = glm::dot(now_.last_heading, now_.heading);
      now_.down = cosine * now_.last_down + sine * glm::cross(unit, now_.last_down) +
                  (1 - cosine) * glm::dot(unit, now_.last_down) * unit;
    }
    now_.left = glm::cross(now_.heading, now_.down);
  }

  void set_position() {
    const std::span<const float> values = modules_.parameters();
    if (values.size() < 2) return;
    now_.position = Vec3(values[0], values[1], values.size() > 2 ? values[2] : 0);
  }

  // Parameters are in single precision: a sixth or a third of the width is meant where rounding made it a little else.
  static double nearest_limit(double swelling, double width) {
    constexpr double kRounding = 1e-6;
    for (const double limit : {width / 6, width / 3}) {
      if (std::fabs(swelling - limit) <= kRounding * limit) return limit;
    }
    return swelling;
  }

  void set_ridge() {
    if (!has_value()) {
      now_.ridge = kNoRidge;
      return;
    }
    const double width = value(),
                 swelling = nearest_limit(modules_.parameters().size() > 1 ? value(1) : width / 4, width);
    if (!(0 < width && width <= 0.5)) {
      fail(fmt::format("the ridge's width is {:g} here; expected one above 0 and up to 0.5", width));
    }
    if (!(width / 6 <= swelling && swelling <= 0.5)) {
      fail(fmt::format("the ridge's swelling is {:g} here; expected one from a sixth of its width, {:g}, to 0.5",
                       swelling, width / 6));
    }
    const auto [known, is_new] =
        ridges_.emplace(std::pair(width, swelling), static_cast<std::int32_t>(skeleton_.ridges.size()));
    if (is_new) skeleton_.ridges.push_back({width, swelling});
    now_.ridge = known->second;
  }

  const Word& word_;
  const Grammar* const grammar_;
  const TurtleOptions& options_;
  InterpretedModules modules_;
  State now_;
  std::vector<State> stack_;
  std::vector<double> sub_lsystem_scales_;
  std::size_t next_cut_ = 0;
  bool segment_is_open_ = false;  // the last internode's tip has no width yet
  std::set<std::string> noted_;
  std::map<std::pair<double, double>, std::int32_t> ridges_;  // by width and swelling
  Skeleton skeleton_;
};

}  // namespace

Skeleton interpret(const Word& word, const Grammar* grammar, const TurtleOptions& options) {
  return Turtle(word, grammar, options).run();
}

}  // namespace barkridge
