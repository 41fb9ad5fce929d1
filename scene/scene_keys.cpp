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

std::optional<Interval> interval_of(const SettingValue& value, const Range& range) {
  const auto* ends = std::get_if<std::vector<double>>(&value);
  if (!ends || ends->size() != 2) return std::nullopt;
  const Interval interval{(*ends)[0], (*ends)[1]};
  if (!range.contains(interval.lo) || !range.contains(interval.hi) || interval.empty()) return std::nullopt;
  return interval;
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
std::string text_of(const Interval& x) { return fmt::format("[{}, {}]", x.lo, x.hi); }
std::string text_of(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
template <typename Integer>
std::enable_if_t<std::is_integral_v<Integer>, std::string> text_of(Integer x) {
  return fmt::format("{}", x);
}
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

// A key of every table in a row, `section.N.rest`. Its value is that of all of them.
template <typename At>
SceneKey rule_key(const std::string& rest, std::string takes, std::string meaning, At at,
                  std::function<bool(SceneRidgeRule&, const SettingValue&)> set) {
  return {"ridge.N." + rest, std::move(takes), std::move(meaning),
          [set](Scene& scene, const Setting& setting) {
            const std::string number = setting.key.substr(setting.key.find('.') + 1);
            return set(scene.ridge_rules[std::stoi(number)], setting.value);
          },
          [at](const Scene& scene) {
            std::string text;
            for (const auto& [number, rule] : scene.ridge_rules) {
              text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", number, text_of(at(rule)));
            }
            return text;
          }};
}

template <typename At>
SceneKey rule_range(const std::string& rest, Range range, const std::string& example, At at, std::string meaning) {
  return rule_key(rest, fmt::format("the lowest and the highest, like {}, each {}", example, in_words(range, "number")),
                  std::move(meaning), at, [range, at](SceneRidgeRule& rule, const SettingValue& value) {
                    const std::optional<Interval> interval = interval_of(value, range);
                    if (interval) at(rule) = *interval;
                    return interval.has_value();
                  });
}

template <typename At>
SceneKey rule_number(const std::string& rest, Range range, At at, std::string meaning) {
  return rule_key(rest, in_words(range, "number"), std::move(meaning), at,
                  [range, at](SceneRidgeRule& rule, const SettingValue& value) {
                    const std::optional<double> x = number_of(value);
                    if (!x || !range.contains(*x)) return false;
                    at(rule) = *x;
                    return true;
                  });
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

void add_surface_keys(Keys& keys) {
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
      "Up to this turn faded joints round their corners; past it the axis keeps its radius around a sharp one."));
  keys.push_back(number(
      "junction.width", {0, 0.5, true, false}, [](auto& s) -> auto& { return s.tree.contact.width; },
      "Extent of the swelling beside a ridge, in field units."));
  keys.push_back(number(
      "junction.swelling", {0, 0.5, true, false}, [](auto& s) -> auto& { return s.tree.contact.swelling; },
      "Height of the swelling, from a sixth to a third of the width. Left out, a quarter of it."));
  keys.push_back(flag(
      "junction.allow_large_swelling", [](auto& s) -> auto& { return s.tree.contact.allow_large_swelling; },
      "Lets the swelling exceed a third of the width."));
  keys.push_back(rule_range(
      "orders", at_least(0), "[0, 1]", [](auto& r) -> auto& { return r.orders; },
      "Orders of the internode that carries the fork; 0 is the trunk's, and the ground's."));
  keys.push_back(rule_range(
      "angles_degrees", from_to(0, 180), "[0, 40]", [](auto& r) -> auto& { return r.angles_degrees; },
      "Angles between the two thickest branches of the fork."));
  keys.push_back(rule_range(
      "radius_ratios", from_to(0, 1), "[0.5, 1]", [](auto& r) -> auto& { return r.radius_ratios; },
      "Radii of the second thickest branch over that of the thickest."));
  keys.push_back(rule_number(
      "width", {0, 0.5, true, false}, [](auto& r) -> auto& { return r.width; },
      "The ridge's width at such forks. Left out, junction.width."));
  keys.push_back(rule_number(
      "swelling", {0, 0.5, true, false}, [](auto& r) -> auto& { return r.swelling; },
      "Its swelling. Left out, a quarter of its width."));
  keys.push_back(number(
      "bend.angle_degrees", {0, 180, false, true}, [](auto& s) -> auto& { return s.tree.bend_angle_degrees; },
      "Total angle by which internodes are bent that leave their parent's direction."));
  keys.push_back(number(
      "mesh.cell_size", above(0), [](auto& s) -> auto& { return s.cell_size; },
      "Edge length of the sampling cells. Left out, half the thinnest branch's radius."));
  keys.push_back(integer(
      "mesh.max_triangles", 1, kMost, [](auto& s) -> auto& { return s.max_triangles; },
      "Most triangles. Left out, as many as the machine's memory holds."));
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

void add_image_keys(Keys& keys) {
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
  add_surface_keys(keys);
  add_camera_keys(keys);
  add_light_keys(keys);
  add_surroundings_keys(keys);
  add_image_keys(keys);
  return keys;
}

std::string_view take_part(std::string_view& name) {
  const std::size_t dot = std::min(name.find('.'), name.size());
  const std::string_view part = name.substr(0, dot);
  name.remove_prefix(std::min(dot + 1, name.size()));
  return part;
}

bool is_number_of_table(std::string_view part) {
  constexpr std::size_t kMostDigits = 6;
  return !part.empty() && part.size() <= kMostDigits && part.find_first_not_of("0123456789") == part.npos;
}

bool is_name_of(std::string_view key, std::string_view name) {
  while (!key.empty() && !name.empty()) {
    const std::string_view wanted = take_part(key), part = take_part(name);
    const bool fits = wanted == "NAME" ? !part.empty() : wanted == "N" ? is_number_of_table(part) : wanted == part;
    if (!fits) return false;
  }
  return key.empty() && name.empty();
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const Keys keys = make_keys();
  return keys;
}

const SceneKey* find_scene_key(std::string_view name) {
  for (const SceneKey& key : scene_keys()) {
    if (is_name_of(key.name, name)) return &key;
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
