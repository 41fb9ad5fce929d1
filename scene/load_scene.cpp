#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/output_file.h"
#include "scene/key_suggestion.h"
#include "scene/scene.h"
#include "scene/scene_keys.h"
#include "scene/setting.h"

namespace barkridge {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSceneBytes = std::size_t{64} << 20;

// Of the keys of a row on the left only one may be given, and none together with those on its right.
struct Exclusion {
  std::vector<std::string> alternatives;
  std::vector<std::string> others;
};
const std::vector<Exclusion>& exclusions() {
  static const std::vector<Exclusion> table = {
      {{"model.lsystem", "model.lsystem_text", "model.string", "model.skeleton", "model.lst", "model.tree"}, {}},
      {{"sun.direction"}, {"sun.azimuth_degrees", "sun.elevation_degrees"}},
      {{"surface.max_angle_degrees"}, {"surface.limit", "surface.noise"}},
      {{"camera.position"}, {"camera.azimuth_degrees", "camera.elevation_degrees", "camera.zoom"}},
  };
  return table;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool exclude_each_other(const std::string& a, const std::string& b) {
  return std::any_of(exclusions().begin(), exclusions().end(), [&](const Exclusion& exclusion) {
    const bool a_left = has(exclusion.alternatives, a), b_left = has(exclusion.alternatives, b);
    return a != b &&
           ((a_left && b_left) || (a_left && has(exclusion.others, b)) || (b_left && has(exclusion.others, a)));
  });
}

std::string read_input(const std::string& path, const SourceLocation& named_at, std::size_t limit) {
  try {
    return read_file(path, limit);
  } catch (const IoError& error) {
    throw InputError(named_at, fmt::format("cannot read {}", error.what()));
  }
}

// The settings of a file of any kind: one that is no scene file is a scene that names it.
std::vector<Setting> settings_of_file(const std::string& path) {
  static const std::map<std::string, std::string> kModelKeys = {{".l", "model.lsystem"},
                                                                {".str", "model.string"},
                                                                {".lstring", "model.string"},
                                                                {".skel", "model.skeleton"},
                                                                {".lst", "model.lst"}};
  const std::string extension = fs::path(path).extension().string();
  if (extension == ".toml") return read_settings(read_input(path, {}, kMaxSceneBytes), path);
  const auto found = kModelKeys.find(extension);
  if (found == kModelKeys.end()) {
    throw InputError(
        fmt::format("{}: expected a file that ends in .toml (scene), .l (L-system), .str or .lstring (cpfg string) "
                    ".skel (skeleton table) or .lst (TreeDraw's list)",
                    path));
  }
  Setting setting;
  setting.key = found->second;
  setting.value = fs::path(path).filename().string();
  return {setting};
}

// An unknown name, or a section where a value was expected or the other way round.
[[noreturn]] void refuse_key(const Setting& setting) {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys()) {
    names.push_back(key.name);
    if (key.name.starts_with(setting.key + '.')) {
      throw InputError(setting.value_place, fmt::format("{}: expected a table with keys like {}, not {}", setting.key,
                                                        key.name, describe(setting.value)));
    }
  }
  const std::string nearest = nearest_name(setting.key, names);
  throw InputError(setting.key_place, fmt::format("unknown key {}{}", setting.key,
                                                  nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
}

bool is_empty_section(const Setting& setting) {
  return std::holds_alternative<UnusableValue>(setting.value) && describe(setting.value) == "a table" &&
         std::any_of(scene_keys().begin(), scene_keys().end(),
                     [&](const SceneKey& key) { return key.name.starts_with(setting.key + '.'); });
}

void apply(const Setting& setting, Scene& scene) {
  if (is_empty_section(setting)) return;
  const SceneKey* key = find_scene_key(setting.key);
  if (!key) refuse_key(setting);
  if (!key->set(scene, setting)) {
    throw InputError(setting.value_place,
                     fmt::format("{}: expected {}, not {}", setting.key, key->takes, describe(setting.value)));
  }
}

const Setting* find(const std::vector<Setting>& settings, const std::string& key) {
  const auto found = std::find_if(settings.rbegin(), settings.rend(), [&](const Setting& s) { return s.key == key; });
  return found == settings.rend() ? nullptr : &*found;
}

SourceLocation place_of(const std::vector<Setting>& settings, std::initializer_list<const char*> keys,
                        const std::string& path) {
  for (const char* key : keys) {
    if (const Setting* setting = find(settings, key)) return setting->value_place;
  }
  return {path, 0, 0, ""};
}

void check_exclusions(const std::vector<Setting>& settings) {
  std::vector<const Setting*> seen;
  for (const Setting& setting : settings) {
    const bool concerned = std::any_of(exclusions().begin(), exclusions().end(), [&](const Exclusion& e) {
      return has(e.alternatives, setting.key) || has(e.others, setting.key);
    });
    if (!concerned) continue;
    for (const Setting* earlier : seen) {
      if (!exclude_each_other(setting.key, earlier->key)) continue;
      throw InputError(setting.key_place,
                       fmt::format("{} cannot be given together with {}", setting.key, earlier->key));
    }
    seen.push_back(&setting);
  }
}

// What an override gives leaves the settings before it, an array of tables with all that is in it; and so does what
// cannot stand beside it, from a file.
void remove_overridden(std::vector<Setting>& settings, const std::vector<Setting>& overriding, bool from_file) {
  std::erase_if(settings, [&](const Setting& setting) {
    return std::any_of(overriding.begin(), overriding.end(), [&](const Setting& other) {
      return setting.key == other.key || setting.key.starts_with(other.key + "[].") ||
             (from_file && exclude_each_other(setting.key, other.key));
    });
  });
}

// Reads the model's file, or gives its text the place where it stands.
void complete_model(const std::vector<Setting>& settings, const std::string& path, Scene& scene) {
  const std::vector<std::string>& keys = exclusions()[0].alternatives;
  const auto given = std::find_if(settings.begin(), settings.end(), [&](const Setting& s) { return has(keys, s.key); });
  if (given == settings.end()) {
    throw InputError({path, 0, 0, ""},
                     fmt::format("there is no model; expected one of the keys {}", fmt::join(keys, ", ")));
  }
  ModelSource& model = scene.model;
  if (given->key == "model.lsystem_text" || given->key == "model.tree") {
    model.file = given->value_place.file;
    model.text.insert(0, std::string(static_cast<std::size_t>(given->text_line - 1), '\n') +
                             std::string(static_cast<std::size_t>(given->text_column - 1), ' '));
    return;
  }
  const bool from_override = given->value_place.line == 0 && given->value_place.file != "";
  model.file = (from_override ? fs::path(model.text) : fs::path(path).parent_path() / model.text).string();
  model.text = read_input(model.file, given->value_place, std::size_t{1} << 32);
}

// Makes the path of the bark's image one from the working directory, and looks whether there is something.
void complete_bark(const std::vector<Setting>& settings, const std::string& path, Scene& scene) {
  const Setting* given = find(settings, "bark.image");
  if (scene.bark.kind == BarkKind::kImage && !given) {
    throw InputError(place_of(settings, {"bark.kind"}, path), "bark.kind: image bark needs the key bark.image");
  }
  if (!given) return;
  const bool from_override = given->value_place.line == 0 && given->value_place.file != "";
  if (!from_override) scene.bark.image = (fs::path(path).parent_path() / scene.bark.image).string();
  if (!fs::is_regular_file(scene.bark.image)) {
    throw InputError(given->value_place, fmt::format("cannot read {}: there is no such file", scene.bark.image));
  }
}

// Where the shape of one of the ridge rules is stated.
SourceLocation place_of_ridge(const std::vector<Setting>& settings, std::size_t rule, const std::string& path) {
  for (const char* const key : {"ridge[].swelling", "ridge[].width"}) {
    for (const Setting& setting : settings) {
      if (setting.key == key && setting.element.value_or(rule) == rule) return setting.value_place;
    }
  }
  return {path, 0, 0, ""};
}

// Gives every ridge rule the shape that it leaves to the scene.
void complete_ridge_rules(const std::vector<Setting>& settings, const std::string& path, Scene& scene) {
  for (std::size_t i = 0; i < scene.ridges.size(); ++i) {
    const SceneRidgeRule& stated = scene.ridges[i];
    ContactShape contact = scene.tree.contact;
    contact.width = stated.width.value_or(contact.width);
    contact.swelling = stated.swelling.value_or(contact.width / 4);
    try {
      check(contact);
    } catch (const InputError& error) {
      throw InputError(place_of_ridge(settings, i, path), error.message());
    }
    scene.tree.ridge_rules.push_back({stated.orders, stated.angles_degrees, stated.radius_ratios, contact});
  }
}

// Rules about several keys at once.
void check_together(const std::vector<Setting>& settings, const std::string& path, Scene& scene) {
  ContactShape& contact = scene.tree.contact;
  if (!find(settings, "junction.swelling")) contact.swelling = contact.width / 4;
  try {
    check(contact);
  } catch (const InputError& error) {
    throw InputError(place_of(settings, {"junction.swelling", "junction.width"}, path), error.message());
  }
  complete_ridge_rules(settings, path, scene);
  if (scene.camera.position && scene.camera.target && *scene.camera.position == *scene.camera.target) {
    throw InputError(place_of(settings, {"camera.target"}, path),
                     "camera.target: expected another point than camera.position");
  }
  if (scene.turtle.growth.time && scene.model.kind != ModelSource::Kind::kLsystem) {
    throw InputError(place_of(settings, {"growth.time"}, path),
                     "growth.time: expected an L-system as the model; no other can grow");
  }
  if (static_cast<std::int64_t>(scene.image.width) * scene.image.height > (std::int64_t{1} << 31)) {
    throw LimitError(place_of(settings, {"image.width", "image.height"}, path),
                     fmt::format("a picture of {} x {} pixels; expected at most 2^31 pixels", scene.image.width,
                                 scene.image.height));
  }
}

}  // namespace

Override parse_override(const std::string& definition) {
  const std::size_t equals = definition.find('=');
  const auto trimmed = [](const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
  };
  const std::string origin = "-D " + definition;
  const std::string key = trimmed(definition.substr(0, equals));
  if (equals == std::string::npos || key.empty()) {
    throw InputError({origin, 0, 0, ""}, "expected key=value, like -D junction.kind=smooth");
  }
  return {key, trimmed(definition.substr(equals + 1)), origin};
}

Scene load_scene(const std::string& path, std::span<const Override> overrides) {
  std::vector<Setting> overriding;
  for (const Override& o : overrides) {
    const std::vector<Setting> given = read_override_settings(o.key, o.value, o.origin);
    remove_overridden(overriding, given, false);
    overriding.insert(overriding.end(), given.begin(), given.end());
  }
  std::vector<Setting> settings = settings_of_file(path);
  // What the file says must be right even where it is overridden.
  check_exclusions(settings);
  check_exclusions(overriding);
  Scene checked;
  for (const Setting& setting : settings) apply(setting, checked);

  remove_overridden(settings, overriding, true);
  settings.insert(settings.end(), overriding.begin(), overriding.end());
  Scene scene;
  for (const Setting& setting : settings) apply(setting, scene);
  complete_model(settings, path, scene);
  complete_bark(settings, path, scene);
  check_together(settings, path, scene);
  return scene;
}

}  // namespace barkridge
