#pragma once
// The one table of everything that a scene can set: by it scenes are read, hashed, checked and documented.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "scene/setting.h"

namespace barkridge {

struct SceneKey {
  /// Dotted; a part `NAME` in capitals stands for any name, a part `N` for the number of a table in a row of tables.
  std::string name;
  /// What its value is, as in "expected ...".
  std::string takes;
  std::string meaning;
  /// Stores the setting's value; false if it is not what the key takes.
  std::function<bool(Scene&, const Setting&)> set;
  /// The value in a canonical text; empty where it is left to the program.
  std::function<std::string(const Scene&)> value;
};

/// Every key, in the order of the documentation.
const std::vector<SceneKey>& scene_keys();

/// The key of this name, or null.
const SceneKey* find_scene_key(std::string_view name);

/// The table as rows of Markdown, `| key | takes | default | meaning |`, as docs/scene_format.md has them.
std::string scene_keys_markdown();

}  // namespace barkridge
