// Dependencies between rooms go one way. Links cannot see that, because all headers share one root, so the includes are
// read.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace {

// What each room may include besides itself. raytrace and polygonize know a model by one header alone.
const std::map<std::string, std::set<std::string>> kMayInclude{
    {"base", {}},
    {"mesh", {"base"}},
    {"lsystem", {"base"}},
    {"blobtree", {"base", "lsystem/skeleton.h", "lsystem/selection.h"}},
    {"subdivision", {"base", "mesh", "lsystem/skeleton.h"}},
    {"polygonize", {"base", "mesh", "blobtree/field.h"}},
    {"raytrace", {"base", "mesh", "blobtree/field.h"}},
    {"bark",
     {"base", "mesh", "blobtree", "lsystem/skeleton.h", "raytrace/image_texture.h", "raytrace/surface_layers.h",
      "raytrace/surface_shader.h"}},
    {"scene", {"base", "mesh", "lsystem", "blobtree", "subdivision", "polygonize", "raytrace", "bark"}},
    {"study", {"base", "mesh", "lsystem", "blobtree", "subdivision", "polygonize", "raytrace", "bark", "scene"}},
    {"cli", {"base", "mesh", "lsystem", "blobtree", "subdivision", "polygonize", "raytrace", "bark", "scene", "study"}},
};

// The header that a line includes in quotes, or nothing.
std::string included(const std::string& line) {
  const std::string start = "#include \"";
  if (line.compare(0, start.size(), start) != 0) return {};
  return line.substr(start.size(), line.find('"', start.size()) - start.size());
}

}  // namespace

TEST_CASE("no room includes one above it") {
  int includes = 0;
  for (const auto& [room, allowed] : kMayInclude) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(BARKRIDGE_SOURCE_DIR) / room)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        const std::string header = included(line), target = header.substr(0, header.find('/'));
        if (header.empty()) continue;
        ++includes;
        if (target == room) continue;
        CAPTURE(entry.path().string(), header);
        CHECK((allowed.count(target) || allowed.count(header)));
      }
    }
  }
  CHECK(includes > 50);
}
