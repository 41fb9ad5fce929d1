#include "scene/scene_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace barkridge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- What values may be.

struct Range {
  double lo = -kInfinity, hi = kInfinity;
  bool lo_open = false, hi_open = false;

  bool contains(double x) const {
    return std::isfinite(x) && (lo_open ? lo < x : lo <= x) && (hi_open ? x < hi : x <= hi);
  }
};

constexpr Range any() { return {}; }
constexpr Range above(double lo) { return {lo, kInfinity, true, false}; }
constexpr Range at_least(double lo) { return {lo, kInfinity, false, false}; }
constexpr Range from_to(double lo, double hi) { return {lo, hi, false, false}; }

std::string in_words(const Range& range, const char* noun) {
  if (range.lo == -kInfinity) return fmt::format("a finite {}", noun);
  const std::string lower =
      fmt::format("{} {}", range.lo_open ? "above" : (range.hi == kInfinity ? "of at least" : "from"), range.lo);
  if (range.hi == kInfinity) return fmt::format("a finite {} {}", noun, lower);
  if (range.lo_open || range.hi_open) {
    return fmt::format("a {} {} and {} {}", noun, range.lo_open ? lower : fmt::format("of at least {}", range.lo),
                       range.hi_open ? "below" : "up to", range.hi);
  }
  return fmt::format("a {} {} to {}", noun, lower, range.hi);
}

// ---- Reading values.

std::optional<double> number_of(const SettingValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

std::optional<Vec3> vector_of(const SettingValue& value, const Range& range) {
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  for (const double x : *numbers) {
    if (!range.contains(x)) return std::nullopt;
  }
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

// ---- Writing values: shortest texts that read back as the same value.

std::string text_of(double x) { return fmt::format("{}", x); }
std::string text_of(bool x) { return x ? "true" : "false"; }
std::string text_of(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
template <typename Integer>
std::enable_if_t<std::is_integral_v<Integer>, std::string> text_of(Integer x) {
  return fmt::format("{}", x);
}
std::string text_of(const Span& span) { return fmt::format("[{}, {}]", span.from, span.to); }
std::string text_of(const std::vector<InternodeId>& ids) { return fmt::format("[{}]", fmt::join(ids, ", ")); }
template <typename T>
std::string text_of(const std::optional<T>& x) {
  return x ? text_of(*x) : std::string();
}

// ---- Kinds of keys. `at` maps a scene, constant or not, to the place of the value in it.

template <typename At>
SceneKey key_of(std::string name, std::string takes, std::string meaning, At at,
                std::function<bool(Scene&, const Setting&)> set) {
  return {std::move(name), std::move(takes), std::move(meaning), std::move(set),
          [at](const Scene& scene) { return text_of(at(scene)); }};
}

template <typename At>
SceneKey number(std::string name, Range range, At at, std::string meaning) {
  return key_of(std::move(name), in_words(range, "number"), std::move(meaning), at,
                [range, at](Scene& scene, const Setting& setting) {
                  const std::optional<double> x = number_of(setting.value);
                  if (!x || !range.contains(*x)) return false;
                  at(scene) = *x;
                  return true;
                });
}

template <typename T>
struct Held {
  using type = T;
};
template <typename T>
struct Held<std::optional<T>> {
  using type = T;
};

template <typename At>
SceneKey integer(std::string name, std::int64_t lo, std::int64_t hi, At at, std::string meaning) {
  using Integer = typename Held<std::decay_t<decltype(at(std::declval<Scene&>()))>>::type;
  const bool unlimited = hi == std::numeric_limits<std::int64_t>::max();
  std::string takes =
      unlimited ? fmt::format("an integer of at least {}", lo) : fmt::format("an integer from {} to {}", lo, hi);
  if (unlimited && lo == std::numeric_limits<std::int64_t>::min()) takes = "an integer";
  return key_of(std::move(name), std::move(takes), std::move(meaning), at,
                [lo, hi, at](Scene& scene, const Setting& setting) {
                  const auto* x = std::get_if<std::int64_t>(&setting.value);
                  if (!x || *x < lo || *x > hi) return false;
                  at(scene) = static_cast<Integer>(*x);
                  return true;
                });
}

template <typename At>
SceneKey flag(std::string name, At at, std::string meaning) {
  return key_of(std::move(name), "true or false", std::move(meaning), at, [at](Scene& scene, const Setting& setting) {
    const auto* x = std::get_if<bool>(&setting.value);
    if (!x) return false;
    at(scene) = *x;
    return true;
  });
}

template <typename At>
SceneKey vector(std::string name, At at, std::string meaning) {
  return key_of(std::move(name), "three finite numbers, like [0, 1, 0]", std::move(meaning), at,
                [at](Scene& scene, const Setting& setting) {
                  const std::optional<Vec3> v = vector_of(setting.value, any());
                  if (v) at(scene) = *v;
                  return v.has_value();
                });
}

template <typename At>
SceneKey direction(std::string name, At at, std::string meaning) {
  return key_of(std::move(name), "three finite numbers that are not all 0, like [0, 1, 0]", std::move(meaning), at,
                [at](Scene& scene, const Setting& setting) {
                  const std::optional<Vec3> v = vector_of(setting.value, any());
                  const double length = v ? glm::length(*v) : 0.0;
                  if (!(length > 0) || !std::isfinite(length)) return false;
                  at(scene) = *v;
                  return true;
                });
}

template <typename At>
SceneKey color(std::string name, Range range, At at, std::string meaning) {
  return key_of(std::move(name), fmt::format("red, green and blue, each {}", in_words(range, "number")),
                std::move(meaning), at, [range, at](Scene& scene, const Setting& setting) {
                  const std::optional<Vec3> v = vector_of(setting.value, range);
                  if (v) at(scene) = *v;
                  return v.has_value();
                });
}

template <typename Choice>
struct Name {
  Choice choice;
  const char* name;
};

template <typename Choice, typename At>
SceneKey choice(std::string name, std::vector<Name<Choice>> names, At at, std::string meaning) {
  std::string takes;
  for (const Name<Choice>& n : names) takes += fmt::format("{}\"{}\"", takes.empty() ? "" : " or ", n.name);
  return {std::move(name), takes, std::move(meaning),
          [names, at](Scene& scene, const Setting& setting) {
            const auto* text = std::get_if<std::string>(&setting.value);
            for (const Name<Choice>& n : names) {
              if (text && *text == n.name) {
                at(scene) = n.choice;
                return true;
              }
            }
            return false;
          },
          [names, at](const Scene& scene) {
            for (const Name<Choice>& n : names) {
              if (at(scene) == n.choice) return fmt::format("\"{}\"", n.name);
            }
            return std::string();
          }};
}

// ---- Lists of rules: an array of tables, of which each is a rule. `rules` maps a scene to the list.

template <typename Rules>
SceneKey list(std::string name, Rules rules, std::string meaning) {
  return {std::move(name), "an array of tables", std::move(meaning),
          [rules](Scene& scene, const Setting& setting) {
            const auto* tables = std::get_if<TableArray>(&setting.value);
            const auto* nothing = std::get_if<std::vector<double>>(&setting.value);
            if (!tables && !(nothing && nothing->empty())) return false;
            rules(scene).assign(tables ? tables->size : 0, {});
            return true;
          },
          [rules](const Scene& scene) {
            std::string text;
            for (std::size_t i = 0; i < rules(scene).size(); ++i) text += i == 0 ? "{}" : ", {}";
            return '[' + text + ']';
          }};
}

// A key of the list's first rule as a key of the one that the setting is for, or of all.
template <typename Rules>
SceneKey in_list(SceneKey of_first, Rules rules) {
  SceneKey key = of_first;
  key.set = [of_first, rules](Scene& scene, const Setting& setting) {
    auto& all = rules(scene);
    all.resize(std::max(all.size(), setting.element.value_or(0) + 1));
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (setting.element.value_or(i) != i) continue;
      Scene one;
      rules(one) = {all[i]};
      if (!of_first.set(one, setting)) return false;
      all[i] = rules(one).front();
    }
    return true;
  };
  key.value = [of_first, rules](const Scene& scene) {
    std::string text;
    for (std::size_t i = 0; i < std::max<std::size_t>(rules(scene).size(), 1); ++i) {
      Scene one;
      rules(one).resize(1);
      if (!rules(scene).empty()) rules(one) = {rules(scene)[i]};
      text += (i == 0 ? "" : "; ") + of_first.value(one);
    }
    return text;
  };
  return key;
}

template <typename At>
SceneKey range(std::string name, At at, std::string meaning) {
  return key_of(std::move(name), "a number of at least 0, or two, first and last of a range", std::move(meaning), at,
                [at](Scene& scene, const Setting& setting) {
                  std::vector<double> ends;
                  if (const auto* numbers = std::get_if<std::vector<double>>(&setting.value)) ends = *numbers;
                  if (const std::optional<double> x = number_of(setting.value)) ends = {*x, *x};
                  if (ends.size() != 2 || !at_least(0).contains(ends[0]) || !(ends[0] <= ends[1])) return false;
                  at(scene) = {ends[0], ends[1]};
                  return true;
                });
}

template <typename At>
SceneKey ids(std::string name, At at, std::string meaning) {
  return key_of(std::move(name), "integers of at least 0, like [3, 17]", std::move(meaning), at,
                [at](Scene& scene, const Setting& setting) {
                  const auto* numbers = std::get_if<std::vector<double>>(&setting.value);
                  if (!numbers) return false;
                  std::vector<InternodeId> found;
                  for (const double x : *numbers) {
                    if (!(0 <= x && x <= std::numeric_limits<InternodeId>::max() && x == std::floor(x))) return false;
                    found.push_back(static_cast<InternodeId>(x));
                  }
                  at(scene) = found;
                  return true;
                });
}

// The path or text stays in `text` until `load_scene` has read the file or found the text's place.
SceneKey model(std::string name, std::string takes, ModelSource::Kind kind, std::string meaning) {
  return {std::move(name), std::move(takes), std::move(meaning),
          [kind](Scene& scene, const Setting& setting) {
            const auto* text = std::get_if<std::string>(&setting.value);
            if (!text || text->empty()) return false;
            scene.model.kind = kind;
            scene.model.text = *text;
            return true;
          },
          [](const Scene&) { return std::string(); }};
}

bool set_define(Scene& scene, const Setting& setting) {
  std::string& value = scene.defines[setting.key.substr(setting.key.rfind('.') + 1)];
  if (const auto* text = std::get_if<std::string>(&setting.value)) {
    value = *text;
  } else if (const auto* integer = std::get_if<std::int64_t>(&setting.value)) {
    value = text_of(*integer);
  } else if (const auto* number = std::get_if<double>(&setting.value); number && std::isfinite(*number)) {
    value = text_of(*number);
  } else {
    return false;
  }
  return true;
}

bool is_version(Scene&, const Setting& setting) {
  const auto* version = std::get_if<std::int64_t>(&setting.value);
  return version && *version == 1;
}

// ---- The table, a section a function.

using Keys = std::vector<SceneKey>;

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();

void add_model_keys(Keys& keys) {
  using Kind = ModelSource::Kind;
  keys.push_back({"version", "1", "Version of the scene format.", is_version, [](const Scene&) { return "1"; }});
  keys.push_back(model("model.lsystem", "the path of an L-system (.l)", Kind::kLsystem,
                       "Grows the model from an L-system in a file."));
  keys.push_back(model("model.lsystem_text", "the text of an L-system", Kind::kLsystem,
                       "Grows the model from an L-system in the scene."));
  keys.push_back(model("model.string", "the path of a cpfg string (.str)", Kind::kString,
                       "Draws the model from a string of modules in a file."));
  keys.push_back(model("model.skeleton", "the path of a skeleton table (.skel)", Kind::kSkeleton,
                       "Takes the model's skeleton from a file."));
  keys.push_back(model("model.lst", "the path of an LST file (.lst)", Kind::kLst,
                       "Takes the model's skeleton from a file that lists operations, in TreeDraw's format."));
  keys.push_back(model("model.tree", "a BlobTree as text", Kind::kTree,
                       "The model itself, written by hand in the BlobTree's text form."));
}

void add_lsystem_keys(Keys& keys) {
  keys.push_back(integer(
      "lsystem.steps", 0, 1'000'000, [](auto& s) -> auto& { return s.derivation.steps; },
      "Derivation steps. Left out, what the L-system says."));
  keys.push_back(integer(
      "lsystem.seed", kLeast, kMost, [](auto& s) -> auto& { return s.derivation.seed; },
      "Seed of the stochastic choice. Left out, what the L-system says."));
  keys.push_back(integer(
      "lsystem.max_modules", 1, kMost, [](auto& s) -> auto& { return s.derivation.max_modules; },
      "Most modules that a derivation step may make."));
  keys.push_back(integer(
      "lsystem.max_memory", 1, kMost, [](auto& s) -> auto& { return s.derivation.max_memory; },
      "Most bytes for the string."));
  keys.push_back({"lsystem.defines.NAME", "a finite number or a text",
                  "Replaces the value of the L-system's own #define of this name.", set_define,
                  [](const Scene&) { return std::string(); }});
}

void add_turtle_keys(Keys& keys) {
  keys.push_back(number(
      "turtle.angle_increment_degrees", any(), [](auto& s) -> auto& { return s.turtle.angle_increment_degrees; },
      "Turn of a command without argument."));
  keys.push_back(number(
      "turtle.step", above(0), [](auto& s) -> auto& { return s.turtle.step; }, "Length of F without argument."));
  keys.push_back(number(
      "turtle.line_width", above(0), [](auto& s) -> auto& { return s.turtle.line_width; },
      "Width at the start; widths are diameters."));
  keys.push_back(number(
      "turtle.line_width_increment", at_least(0), [](auto& s) -> auto& { return s.turtle.line_width_increment; },
      "Change of width by ! and # without argument."));
  keys.push_back(number(
      "turtle.initial_scale", above(0), [](auto& s) -> auto& { return s.turtle.initial_scale; },
      "Factor of lengths and widths at the start."));
  keys.push_back(number(
      "turtle.scale_multiplier", above(0), [](auto& s) -> auto& { return s.turtle.scale_multiplier; },
      "Factor of @Di and @Dd without argument."));
  keys.push_back(integer(
      "turtle.color", 0, 255, [](auto& s) -> auto& { return s.turtle.color; }, "Colour index at the start."));
  keys.push_back(integer(
      "turtle.color_increment", 0, 255, [](auto& s) -> auto& { return s.turtle.color_increment; },
      "Change of colour by ; and , without argument."));
  keys.push_back(flag(
      "turtle.tapered_lines", [](auto& s) -> auto& { return s.turtle.tapered_lines; },
      "Whether ! and # after a segment set the width of its tip."));
  keys.push_back(integer(
      "turtle.max_internodes", 1, std::numeric_limits<std::int32_t>::max(),
      [](auto& s) -> auto& { return s.turtle.max_internodes; }, "Most internodes that a skeleton may have."));
}

void add_growth_keys(Keys& keys) {
  keys.push_back(number(
      "growth.time", from_to(0, kMaxGrowthTime), [](auto& s) -> auto& { return s.turtle.growth.time; },
      "Age of the plant, in derivation steps, whole or not. Left out, all steps are taken and all is grown up."));
  keys.push_back(number(
      "growth.steps_per_frame", above(0), [](auto& s) -> auto& { return s.sequence.steps_per_frame; },
      "Time from one of the frames of `--frames` to the next, in derivation steps."));
  keys.push_back(number(
      "growth.framed_time", from_to(0, kMaxGrowthTime), [](auto& s) -> auto& { return s.sequence.framed_time; },
      "The time at which a fitted camera sees the whole plant, whatever `growth.time`. Left out, when it is grown "
      "up."));
  keys.push_back(choice<GrowthCurve>(
      "growth.curve", {{GrowthCurve::kSigmoid, "sigmoid"}, {GrowthCurve::kPower, "power"}},
      [](auto& s) -> auto& { return s.turtle.growth.curve; },
      "How sizes follow age: slow, fast and slow again, or by a power of it."));
  keys.push_back(number(
      "growth.exponent", at_least(1), [](auto& s) -> auto& { return s.turtle.growth.exponent; },
      "The power; 1 grows evenly."));
  keys.push_back(number(
      "growth.elongation_steps", at_least(0), [](auto& s) -> auto& { return s.turtle.growth.elongation_steps; },
      "Age at which internodes are as long, and organs as large, as they are drawn; 0 for at once."));
  keys.push_back(number(
      "growth.opening_steps", at_least(0), [](auto& s) -> auto& { return s.turtle.growth.opening_steps; },
      "Age at which turns (+ - & ^) have their angles; 0 for at once."));
  keys.push_back(number(
      "growth.thickening_steps", at_least(0), [](auto& s) -> auto& { return s.turtle.growth.thickening_steps; },
      "Age at which widths are those drawn, or a tip that of the pipe model; 0 for at once."));
  keys.push_back(number(
      "growth.tip_radius", above(0), [](auto& s) -> auto& { return s.turtle.growth.pipe.tip_radius; },
      "Radius of tips, from which the pipe model has all others. Left out, widths are those drawn."));
  keys.push_back(number(
      "growth.pipe_exponent", from_to(1, 10), [](auto& s) -> auto& { return s.turtle.growth.pipe.exponent; },
      "The exponent whose power of the radius branches share; 2 is da Vinci's rule."));
  keys.push_back(number(
      "growth.healing_steps", above(0), [](auto& s) -> auto& { return s.turtle.growth.healing_steps; },
      "How long the scars of branches that % removes take to heal. Left out, they leave none."));
}

void add_ridge_keys(Keys& keys) {
  const auto ridges = [](auto& s) -> auto& { return s.ridges; };
  const auto add = [&](SceneKey key) { keys.push_back(in_list(std::move(key), ridges)); };
  keys.push_back(list("ridge", ridges, "Other ridges for some forks; the last rule for one counts."));
  add(range(
      "ridge[].order", [](auto& s) -> auto& { return s.ridges.front().orders; },
      "Only forks that internodes of these orders carry; the trunk's is 0, and the ground's."));
  add(range(
      "ridge[].angle_degrees", [](auto& s) -> auto& { return s.ridges.front().angles_degrees; },
      "Only forks with these angles between their two thickest branches."));
  add(range(
      "ridge[].radius_ratio", [](auto& s) -> auto& { return s.ridges.front().radius_ratios; },
      "Only forks with these radii of the second thickest branch over that of the thickest."));
  add(number(
      "ridge[].width", {0, 0.5, true, false}, [](auto& s) -> auto& { return s.ridges.front().width; },
      "The ridge's width. Left out, junction.width."));
  add(number(
      "ridge[].swelling", {0, 0.5, true, false}, [](auto& s) -> auto& { return s.ridges.front().swelling; },
      "Its swelling. Left out, a quarter of its width."));
}

void add_surface_keys(Keys& keys) {
  keys.push_back(choice<SurfaceMethod>(
      "surface.method",
      {{SurfaceMethod::kImplicit, "implicit"},
       {SurfaceMethod::kTemplates, "templates"},
       {SurfaceMethod::kHull, "hull"},
       {SurfaceMethod::kCylinders, "cylinders"},
       {SurfaceMethod::kLeaf, "leaf"}},
      [](auto& s) -> auto& { return s.surface.method; },
      "How the model gets its surface: by the field of its BlobTree, or by Loop subdivision of a control mesh."));
  keys.push_back(integer(
      "surface.level", 0, 10, [](auto& s) -> auto& { return s.surface.level; },
      "Times that each triangle of a control mesh is split in four, or at the most is."));
  keys.push_back(number(
      "surface.max_angle_degrees", {0, 180, true, false}, [](auto& s) -> auto& { return s.surface.max_angle_degrees; },
      "Splits only where triangles meet at more than this angle. Left out, all are split alike."));
  keys.push_back(flag(
      "surface.limit", [](auto& s) -> auto& { return s.surface.limit; },
      "Whether the vertices of a refined control mesh are moved to its limit surface."));
  keys.push_back(number(
      "surface.noise", at_least(0), [](auto& s) -> auto& { return s.surface.noise.amplitude; },
      "Amplitude of the noise by which every step moves vertices, in scene units; then there is no limit surface."));
  keys.push_back(number(
      "surface.noise_hurst", from_to(0, 1), [](auto& s) -> auto& { return s.surface.noise.hurst; },
      "How much less noise finer steps have: 0 as much, 1 hardly any."));
  keys.push_back(number(
      "surface.noise_bias", {0, 1, true, false}, [](auto& s) -> auto& { return s.surface.noise.bias; },
      "How noise falls with age: 0.5 in proportion, less spares the young more, 1 no one."));
  keys.push_back(integer(
      "surface.noise_seed", 0, kMost, [](auto& s) -> auto& { return s.surface.noise.seed; }, "Seed of the noise."));
  keys.push_back(choice<StemTip>(
      "surface.tip", {{StemTip::kCapped, "capped"}, {StemTip::kSharp, "sharp"}, {StemTip::kTapered, "tapered"}},
      [](auto& s) -> auto& { return s.surface.tip; },
      "How branches by templates and cylinders end: rounded, by a cut, or in a point."));
  keys.push_back(choice<StemTexture>(
      "surface.texture", {{StemTexture::kReflected, "reflected"}, {StemTexture::kCylindrical, "cylindrical"}},
      [](auto& s) -> auto& { return s.surface.texture; },
      "Their texture coordinates: six reflected copies around without seams, or unrolled with seams."));
  keys.push_back(choice<JunctionKind>(
      "junction.kind", {{JunctionKind::kRidge, "ridge"}, {JunctionKind::kSmooth, "smooth"}},
      [](auto& s) -> auto& { return s.tree.junction; }, "Whether branches that meet raise a bark ridge or blend."));
  keys.push_back(choice<JointKind>(
      "junction.joint", {{JointKind::kFaded, "faded"}, {JointKind::kPaper, "paper"}},
      [](auto& s) -> auto& { return s.tree.joint; },
      "How an internode hands over to the next: by fading fields, or by shortened skeletons."));
  keys.push_back(choice<BlendingKind>(
      "junction.blending", {{BlendingKind::kSubtrees, "subtrees"}, {BlendingKind::kConfined, "confined"}},
      [](auto& s) -> auto& { return s.tree.blending; },
      "What a junction joins: all that grows from it, or only the internodes that meet there."));
  keys.push_back(number(
      "junction.round_turn_degrees", from_to(0, 180), [](auto& s) -> auto& { return s.tree.round_turn_degrees; },
      "Up to this turn, twice as much at forks, faded joints round their corners; past it the axis keeps its radius "
      "around a sharp one."));
  keys.push_back(number(
      "junction.width", {0, 0.5, true, false}, [](auto& s) -> auto& { return s.tree.contact.width; },
      "Extent of the swelling beside a ridge, in field units."));
  keys.push_back(number(
      "junction.swelling", {0, 0.5, true, false}, [](auto& s) -> auto& { return s.tree.contact.swelling; },
      "Height of the swelling, from a sixth to a third of the width. Left out, a quarter of it."));
  keys.push_back(flag(
      "junction.allow_large_swelling", [](auto& s) -> auto& { return s.tree.contact.allow_large_swelling; },
      "Lets the swelling exceed a third of the width."));
  add_ridge_keys(keys);
  keys.push_back(number(
      "mesh.cell_size", above(0), [](auto& s) -> auto& { return s.cell_size; },
      "Edge length of the sampling cells. Left out, half the thinnest branch's radius, and at most a quarter of the "
      "finest "
      "displacement's wavelength."));
  keys.push_back(integer(
      "mesh.max_triangles", 1, kMost, [](auto& s) -> auto& { return s.max_triangles; },
      "Most triangles. Left out, as many as the machine's memory holds."));
  keys.push_back(flag(
      "mesh.attributes", [](auto& s) -> auto& { return s.mesh_attributes; },
      "Whether meshes get texture coordinates, attributes and, where bark is not plain, colours."));
}

// `selection` maps a list's rule to its selection; `what` is what it selects, `by` what of it the numbers are.
template <typename Rules, typename Of>
void add_selection_keys(Keys& keys, const std::string& list, Rules rules, Of selection, const std::string& what,
                        const std::string& by) {
  const auto add = [&](SceneKey key) { keys.push_back(in_list(std::move(key), rules)); };
  const auto of_first = [ rules, selection ](auto& scene) -> auto& { return selection(rules(scene).front()); };
  add(ids(
      list + "[].ids", [of_first](auto& s) -> auto& { return of_first(s).ids; },
      "Only these internodes, by their numbers in the skeleton as it was grown or read. Left out or empty, any."));
  add(range(
      list + "[].order", [of_first](auto& s) -> auto& { return of_first(s).order; },
      fmt::format("Only {} of these orders{}; the trunk's is 0.", what, by)));
  add(range(
      list + "[].age", [of_first](auto& s) -> auto& { return of_first(s).age; },
      fmt::format("Only {} of these ages{}, in derivation steps; the youngest internode's is 0.", what, by)));
  add(range(
      list + "[].radius", [of_first](auto& s) -> auto& { return of_first(s).radius; },
      fmt::format("Only {} of these base radii{}.", what, by)));
  add(number(
      list + "[].fraction", from_to(0, 1), [of_first](auto& s) -> auto& { return of_first(s).fraction; },
      fmt::format("Share of these {} that is drawn at random.", what)));
  add(integer(
      list + "[].seed", kLeast, kMost, [of_first](auto& s) -> auto& { return of_first(s).seed; },
      "Seed of that draw."));
}

void add_missing_organ_keys(Keys& keys) {
  const auto cuts = [](auto& s) -> auto& { return s.cuts; };
  const auto add_to_cut = [&](SceneKey key) { keys.push_back(in_list(std::move(key), cuts)); };
  keys.push_back(list("cut", cuts, "Branches that are sawn or broken off."));
  add_to_cut(number(
      "cut[].position", {0, 1, true, true}, [](auto& s) -> auto& { return s.cuts.front().position; },
      "Share of the branch's length that stays; with `ids`, of the internode's."));
  add_to_cut(number(
      "cut[].tilt_degrees", from_to(-kSteepestCutDegrees, kSteepestCutDegrees),
      [](auto& s) -> auto& { return s.cuts.front().tilt_degrees; },
      "Tilt of the cut: the face turns away from the direction of what carries the branch, or towards it."));
  add_to_cut(number(
      "cut[].splinters", from_to(0, kLongestSplinters), [](auto& s) -> auto& { return s.cuts.front().splinters; },
      "Height of the splinters of a torn break, in radii of the branch there; 0 for a clean cut."));
  const auto branches = [](auto& rule) -> auto& { return rule.branches; };
  add_selection_keys(keys, "cut", cuts, branches, "branches", " at their bases");
  const auto scars = [](auto& s) -> auto& { return s.scars; };
  const auto add_to_scar = [&](SceneKey key) { keys.push_back(in_list(std::move(key), scars)); };
  keys.push_back(list("scar", scars, "Branches that are shed and leave scars."));
  add_to_scar(number(
      "scar[].width", above(0), [](auto& s) -> auto& { return s.scars.front().shape.width; },
      "Radius of the hollow, in base radii of the shed branch."));
  add_to_scar(number(
      "scar[].depth", at_least(0), [](auto& s) -> auto& { return s.scars.front().shape.depth; },
      "Depth of the hollow below the stub's top, in such radii."));
  add_to_scar(number(
      "scar[].stub", from_to(0, 1), [](auto& s) -> auto& { return s.scars.front().shape.stub; },
      "Height of the stub over the bark, in such radii."));
  add_selection_keys(keys, "scar", scars, branches, "branches", " at their bases");
}

void add_axis_keys(Keys& keys) {
  const auto internodes = [](auto& rule) -> auto& { return rule.internodes; };
  keys.push_back(number(
      "bend.angle_degrees", {0, 180, false, true}, [](auto& s) -> auto& { return s.tree.bend_angle_degrees; },
      "Total angle by which internodes are bent that leave their parent's direction."));
  const auto bends = [](auto& s) -> auto& { return s.tree.bends; };
  keys.push_back(list("bend.rule", bends, "Angles for some internodes; the last rule for one counts."));
  keys.push_back(in_list(number(
                             "bend.rule[].angle_degrees", {0, 180, false, true},
                             [](auto& s) -> auto& { return s.tree.bends.front().angle_degrees; }, "Their angle."),
                         bends));
  add_selection_keys(keys, "bend.rule", bends, internodes, "internodes", "");
  const auto tips = [](auto& s) -> auto& { return s.tree.tips; };
  keys.push_back(list("tip", tips, "How branches end; the last rule for one counts, and without any it ends round."));
  keys.push_back(
      in_list(choice<TipKind>(
                  "tip[].kind", {{TipKind::kRound, "round"}, {TipKind::kPointed, "pointed"}, {TipKind::kBud, "bud"}},
                  [](auto& s) -> auto& { return s.tree.tips.front().kind; }, "In half a ball, a point or a bud."),
              tips));
  keys.push_back(
      in_list(number(
                  "tip[].length", at_least(kShortestTip), [](auto& s) -> auto& { return s.tree.tips.front().length; },
                  "Length of a point or bud, in tip radii."),
              tips));
  add_selection_keys(keys, "tip", tips, internodes, "last internodes", "");
}

void add_displacement_keys(Keys& keys) {
  keys.push_back(number(
      "displacement.amount", {0, 0.5, false, true}, [](auto& s) -> auto& { return s.tree.displacement.amount; },
      "Share of its value by which noise raises and lowers the field of thick branches; 0 for smooth ones."));
  keys.push_back(number(
      "displacement.wavelength", above(0), [](auto& s) -> auto& { return s.tree.displacement.wavelength; },
      "Distance between furrows. Left out, two fifths of the thickest branch's radius."));
  keys.push_back(number(
      "displacement.stretch", above(0), [](auto& s) -> auto& { return s.tree.displacement.stretch; },
      "By how much furrows are longer along y than across."));
  keys.push_back(integer(
      "displacement.octaves", 1, kMostNoiseOctaves, [](auto& s) -> auto& { return s.tree.displacement.octaves; },
      "Layers of noise, each half as wide and a quarter as deep as the one before."));
  keys.push_back(flag(
      "displacement.ridged", [](auto& s) -> auto& { return s.tree.displacement.ridged; },
      "Whether there are narrow fissures between plateaus, instead of hills and valleys alike."));
  keys.push_back(integer(
      "displacement.seed", 0, std::numeric_limits<int>::max(),
      [](auto& s) -> auto& { return s.tree.displacement.seed; }, "Seed of the noise."));
  keys.push_back(number(
      "displacement.furrowed_radius", above(0), [](auto& s) -> auto& { return s.tree.displacement.furrowed_radius; },
      "Radius of branches that have half of it; thinner ones have less, down to none. Left out, half the thickest "
      "branch's."));
}

void add_camera_keys(Keys& keys) {
  using Projection = Camera::Projection;
  keys.push_back(choice<Projection>(
      "camera.projection", {{Projection::kPerspective, "perspective"}, {Projection::kOrthographic, "orthographic"}},
      [](auto& s) -> auto& { return s.camera.projection; }, "The kind of camera."));
  keys.push_back(vector(
      "camera.position", [](auto& s) -> auto& { return s.camera.position; },
      "Where the camera stands. Left out, far enough to see the whole model."));
  keys.push_back(vector(
      "camera.target", [](auto& s) -> auto& { return s.camera.target; },
      "What it looks at. Left out, the middle of the model."));
  keys.push_back(direction(
      "camera.up", [](auto& s) -> auto& { return s.camera.up; }, "What is up in the picture."));
  keys.push_back(number(
      "camera.fov_degrees", {0, 180, true, true}, [](auto& s) -> auto& { return s.camera.fov_degrees; },
      "Full vertical angle of view of the perspective camera."));
  keys.push_back(number(
      "camera.height", above(0), [](auto& s) -> auto& { return s.camera.height; },
      "Height of an orthographic picture in scene units. Left out, enough for the whole model."));
  keys.push_back(number(
      "camera.azimuth_degrees", any(), [](auto& s) -> auto& { return s.camera.azimuth_degrees; },
      "Direction from the model to the camera, from +z towards +x, where no position is given."));
  keys.push_back(number(
      "camera.elevation_degrees", from_to(-90, 90), [](auto& s) -> auto& { return s.camera.elevation_degrees; },
      "Angle of that direction above the horizon."));
  keys.push_back(number(
      "camera.zoom", above(0), [](auto& s) -> auto& { return s.camera.zoom; },
      "Magnifies what the camera would show by itself."));
}

void add_light_keys(Keys& keys) {
  keys.push_back(direction(
      "sun.direction", [](auto& s) -> auto& { return s.sun.direction; },
      "From the model to the sun; instead of the two angles."));
  keys.push_back(number(
      "sun.azimuth_degrees", any(), [](auto& s) -> auto& { return s.sun.azimuth_degrees; },
      "Direction of the sun, from +z towards +x."));
  keys.push_back(number(
      "sun.elevation_degrees", from_to(-90, 90), [](auto& s) -> auto& { return s.sun.elevation_degrees; },
      "Angle of the sun above the horizon."));
  keys.push_back(color(
      "sun.color", at_least(0), [](auto& s) -> auto& { return s.sun.color; }, "Colour of its light, linear Rec. 709."));
  keys.push_back(number(
      "sun.intensity", at_least(0), [](auto& s) -> auto& { return s.sun.intensity; },
      "Radiance of a white surface that faces the sun."));
  keys.push_back(number(
      "sun.angle_degrees", from_to(0, 90), [](auto& s) -> auto& { return s.sun.angle_degrees; },
      "Full angle that it subtends; 0 gives hard shadows."));
  keys.push_back(color(
      "sky.zenith", at_least(0), [](auto& s) -> auto& { return s.sky.zenith; }, "Colour of the sky overhead."));
  keys.push_back(color(
      "sky.horizon", at_least(0), [](auto& s) -> auto& { return s.sky.horizon; }, "Colour of the sky at the horizon."));
  keys.push_back(number(
      "sky.intensity", at_least(0), [](auto& s) -> auto& { return s.sky.intensity; }, "Factor of both colours."));
}

void add_surroundings_keys(Keys& keys) {
  keys.push_back(flag(
      "ground.enabled", [](auto& s) -> auto& { return s.ground.enabled; }, "Whether there is a ground."));
  keys.push_back(number(
      "ground.height", any(), [](auto& s) -> auto& { return s.ground.height; }, "Its height, y."));
  keys.push_back(color(
      "ground.color", from_to(0, 1), [](auto& s) -> auto& { return s.ground.color; }, "Its colour, linear Rec. 709."));
  keys.push_back(color(
      "material.color", from_to(0, 1), [](auto& s) -> auto& { return s.material.color; },
      "Colour of the model's surface, linear Rec. 709."));
  keys.push_back(number(
      "material.specular", from_to(0, 1), [](auto& s) -> auto& { return s.material.specular; },
      "Reflectance of the gloss at normal incidence; 0 for none."));
  keys.push_back(number(
      "material.roughness", {0, 1, true, false}, [](auto& s) -> auto& { return s.material.roughness; },
      "Roughness of the gloss."));
}

void add_bark_keys(Keys& keys) {
  keys.push_back(choice<BarkKind>(
      "bark.kind",
      {{BarkKind::kPlain, "plain"},
       {BarkKind::kEven, "even"},
       {BarkKind::kPoplar, "poplar"},
       {BarkKind::kImage, "image"}},
      [](auto& s) -> auto& { return s.bark.kind; },
      "One material everywhere; or the same with dark ridges and wood on cuts; or a poplar's bark; or an image."));
  keys.push_back(number(
      "bark.scale", above(0), [](auto& s) -> auto& { return s.bark.scale; },
      "Width of a furrowed ridge of bark. Left out, a fifth of the thickest branch's radius."));
  keys.push_back(number(
      "bark.furrowed_radius", above(0), [](auto& s) -> auto& { return s.bark.furrowed_radius; },
      "Radius of branches that are half smooth, half furrowed. Left out, half the thickest branch's."));
  keys.push_back({"bark.image", "the path of an image", "The image of image bark.",
                  [](Scene& scene, const Setting& setting) {
                    const auto* text = std::get_if<std::string>(&setting.value);
                    if (!text || text->empty()) return false;
                    scene.bark.image = *text;
                    return true;
                  },
                  [](const Scene& scene) { return scene.bark.image; }});
  keys.push_back(number(
      "bark.bump", at_least(0), [](auto& s) -> auto& { return s.bark.bump; },
      "Factor of the height by which the pattern turns the surface's normals."));
  keys.push_back(color(
      "bark.smooth_color", from_to(0, 1), [](auto& s) -> auto& { return s.bark.smooth_color; },
      "Colour of smooth bark, linear Rec. 709."));
  keys.push_back(color(
      "bark.furrowed_color", from_to(0, 1), [](auto& s) -> auto& { return s.bark.furrowed_color; },
      "Colour of furrowed bark's ridges."));
  keys.push_back(color(
      "bark.ridge_color", from_to(0, 1), [](auto& s) -> auto& { return s.bark.ridge_color; },
      "Colour of bark ridges, where branches touch."));
  keys.push_back(number(
      "bark.ridge", from_to(0, 1), [](auto& s) -> auto& { return s.bark.ridge; },
      "How much of that colour they have."));
  keys.push_back(color(
      "wood.color", from_to(0, 1), [](auto& s) -> auto& { return s.bark.wood_color; },
      "Colour of wood, which cuts lay open."));
  keys.push_back(number(
      "wood.ring_width", above(0), [](auto& s) -> auto& { return s.bark.ring_width; },
      "Width of a growth ring. Left out, a fortieth of the thickest branch's radius."));
}

void add_texture_keys(Keys& keys) {
  keys.push_back(number(
      "texture.width", above(0), [](auto& s) -> auto& { return s.texture.width; },
      "Width of the bark that an image covers. Left out, the thickest branch's circumference."));
  keys.push_back(number(
      "texture.height", above(0), [](auto& s) -> auto& { return s.texture.height; },
      "Height of the bark that it covers. Left out, the width."));
  keys.push_back(flag(
      "texture.follows_radius", [](auto& s) -> auto& { return s.texture.follows_radius; },
      "Whether it shrinks with the branch, instead of keeping its size and going fewer times around."));
}

void add_image_keys(Keys& keys) {
  keys.push_back(flag(
      "image.layers", [](auto& s) -> auto& { return s.image_layers; },
      "Whether an EXR has further channels: points, normals, deformation, internodes, texture coordinates."));
  keys.push_back(integer(
      "image.width", 1, 65536, [](auto& s) -> auto& { return s.image.width; }, "Pixels across."));
  keys.push_back(integer(
      "image.height", 1, 65536, [](auto& s) -> auto& { return s.image.height; }, "Pixels down."));
  keys.push_back(integer(
      "image.samples_per_pixel", 1, 65536, [](auto& s) -> auto& { return s.image.samples_per_pixel; },
      "Most samples a pixel; they are spent where neighbours differ."));
  keys.push_back(integer(
      "image.bounces", 0, 1, [](auto& s) -> auto& { return s.image.bounces; },
      "Whether scattered light from sky and surfaces counts, with its shadows: 1, or 0 for the sun's shadows only."));
  keys.push_back(integer(
      "image.seed", 0, kMost, [](auto& s) -> auto& { return s.image.seed; },
      "Seed of all random numbers of the picture."));
}

Keys make_keys() {
  Keys keys;
  add_model_keys(keys);
  add_lsystem_keys(keys);
  add_turtle_keys(keys);
  add_growth_keys(keys);
  add_missing_organ_keys(keys);
  add_axis_keys(keys);
  add_displacement_keys(keys);
  add_surface_keys(keys);
  add_camera_keys(keys);
  add_light_keys(keys);
  add_surroundings_keys(keys);
  add_bark_keys(keys);
  add_texture_keys(keys);
  add_image_keys(keys);
  return keys;
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const Keys keys = make_keys();
  return keys;
}

const SceneKey* find_scene_key(std::string_view name) {
  constexpr std::string_view kAnyName = "NAME";
  for (const SceneKey& key : scene_keys()) {
    const std::string_view stem = std::string_view(key.name).substr(0, key.name.rfind('.') + 1);
    const bool open = key.name.size() == stem.size() + kAnyName.size() && key.name.ends_with(kAnyName);
    if (open ? name.size() > stem.size() && name.starts_with(stem) && name.find('.', stem.size()) == name.npos
             : name == key.name)
      return &key;
  }
  return nullptr;
}

std::string scene_keys_markdown() {
  std::string rows;
  const Scene scene{};
  for (const SceneKey& key : scene_keys()) {
    const std::string value = key.value(scene);
    rows += fmt::format("| `{}` | {} | {} | {} |\n", key.name, key.takes, value.empty() ? "" : '`' + value + '`',
                        key.meaning);
  }
  return rows;
}

}  // namespace barkridge
