#include "scene/scene_keys.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <set>

#include "base/error.h"
#include "base/output_file.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Matchers::Contains;

namespace {

Scene load_with(const ScratchFolder& folder, const std::string& definition) {
  const std::vector<Override> overrides = {parse_override(definition)};
  return load_scene(folder.path("a.toml"), overrides);
}

// A key's name with something in the place of `part`, if that is in it.
std::string with_part(const std::string& name, const std::string& part, const std::string& instead) {
  const std::size_t place = name.find(part);
  if (place == std::string::npos) return name;
  return fmt::format("{}{}{}", name.substr(0, place), instead, name.substr(place + part.size()));
}

std::string name_of_any(const std::string& name) { return with_part(with_part(name, "NAME", "X"), ".N.", ".0."); }

}  // namespace

TEST_CASE("every key has a name of its own and is found by it") {
  std::set<std::string> names;
  for (const SceneKey& key : scene_keys()) {
    CHECK(names.insert(key.name).second);
    CHECK(find_scene_key(name_of_any(key.name)) == &key);
  }
  CHECK(find_scene_key("lsystem.defines.ANYTHING") != nullptr);
  CHECK(find_scene_key("lsystem.defines") == nullptr);
  CHECK(find_scene_key("lsystem.defines.") == nullptr);
  CHECK(find_scene_key("") == nullptr);
}

TEST_CASE("every key's default reads back as the same value") {
  const ScratchFolder folder;
  folder.write("a.toml", "model.tree = 'cone()'");
  for (const SceneKey& key : scene_keys()) {
    const std::string value = key.value(Scene{});
    if (value.empty()) continue;
    CAPTURE(key.name, value);
    CHECK(key.value(load_with(folder, key.name + '=' + value)) == value);
  }
}

TEST_CASE("every key refuses what it does not take and says what that is") {
  const ScratchFolder folder;
  folder.write("a.toml", "model.tree = 'cone()'");
  for (const SceneKey& key : scene_keys()) {
    const std::string name = name_of_any(key.name);
    for (const char* value : {"1979-05-27", "nan", "[nan, 0, 0]", "{}"}) {
      const bool bare_word = key.name.starts_with("model.");
      if (bare_word && value == std::string("nan")) continue;
      CAPTURE(key.name, value);
      CHECK_THROWS_WITH(load_with(folder, name + '=' + value), Contains(name + ": expected " + key.takes + ", not "));
    }
  }
}

TEST_CASE("the scene format's document has every key as it is") {
  const std::string document = read_file(BARKRIDGE_SOURCE_DIR "/docs/scene_format.md");
  std::string rows = scene_keys_markdown();
  while (!rows.empty()) {
    const std::size_t end = rows.find('\n');
    CHECK_THAT(document, Contains(rows.substr(0, end + 1)));
    rows.erase(0, end + 1);
  }
}
