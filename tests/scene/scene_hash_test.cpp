#include "scene/scene_hash.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <set>

#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

const char* const kTable = "# barkridge skeleton 1\n0 -1 0 0 0 0 1 0 0.2 0.1\n";

std::string hash_of(const std::string& path, const std::vector<std::string>& definitions = {}) {
  std::vector<Override> overrides;
  for (const std::string& definition : definitions) overrides.push_back(parse_override(definition));
  const Scene scene = load_scene(path, overrides);
  return scene_hash(scene, make_model(scene));
}

}  // namespace

TEST_CASE("a scene's hash is 64 hexadecimal digits") {
  const ScratchFolder folder;
  const std::string hash = hash_of(folder.write("a.skel", kTable));
  CHECK(hash.size() == 64);
  CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
}

TEST_CASE("names, comments, order and defaults that are written out do not change the hash") {
  const ScratchFolder folder;
  const std::string hash = hash_of(folder.write("a.skel", kTable));
  CHECK(hash_of(folder.write("b.skel", std::string(kTable) + "# a comment\n\n")) == hash);
  CHECK(hash_of(folder.write("a.toml", fmt::format("# look\n[sky]\nintensity = {}\n[model]\nskeleton = 'b.skel'\n",
                                                   Sky{}.intensity))) == hash);
  const std::string tree = hash_of(folder.write("tree.toml", "model.tree = 'cone(tip_radius = 0.5)'"));
  CHECK(hash_of(folder.write("tree2.toml", "model.tree = '''\n# a cone\ncone(tip_radius = 0.50)'''")) == tree);
}

TEST_CASE("size, samples, seed and cells of a picture or mesh do not change the hash") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.skel", kTable);
  CHECK(hash_of(path, {"image.width=9", "image.samples_per_pixel=3", "image.seed=5", "mesh.cell_size=2"}) ==
        hash_of(path));
}

TEST_CASE("everything that is seen changes the hash") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.skel", kTable);
  std::set<std::string> hashes = {hash_of(path)};
  for (const char* definition :
       {"junction.kind=smooth", "junction.joint=paper", "junction.width=0.3", "junction.blending=confined",
        "ridge[].width=0.3", "ridge=[{},{width=0.3}]", "bend.angle_degrees=5", "camera.zoom=2",
        "camera.position=[1,2,3]", "sun.azimuth_degrees=1", "sky.intensity=2", "ground.enabled=false",
        "material.roughness=0.5", "bark.kind=poplar", "bark.scale=0.1"}) {
    CAPTURE(definition);
    CHECK(hashes.insert(hash_of(path, {definition})).second);
  }
  // Of a bark's image its content counts, not its name.
  const auto with_image = [&](const std::string& name, const std::string& content) {
    return hash_of(path, {"bark.kind=image", "bark.image=" + folder.write(name, content)});
  };
  const std::string of_image = with_image("a.png", "one");
  CHECK(hashes.insert(of_image).second);
  CHECK(with_image("b.png", "one") == of_image);
  CHECK(hashes.insert(with_image("a.png", "two")).second);
  CHECK(hashes.insert(hash_of(folder.write("b.skel", "# barkridge skeleton 1\n0 -1 0 0 0 0 1 0 0.2 0.11\n"))).second);
}
