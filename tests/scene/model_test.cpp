#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "scene/model_statistics.h"
#include "scene/pipeline.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Matchers::Contains;

namespace {

Model model_of_text(const std::string& tree) {
  const ScratchFolder folder;
  return make_model(load_scene(folder.write("a.toml", "model.tree = '''\n" + tree + "'''\n")));
}

const char* const kFork =
    "# barkridge skeleton 1\n"
    "0 -1 0 0 0 0 1 0 0.2 0.2\n"
    "1 0 0 1 0 1 2 0 0.1 0.05\n"
    "2 0 0 1 0 -1 2 0 0.1 0.04\n";

}  // namespace

TEST_CASE("an LST file is a model, named by a scene or by itself") {
  const ScratchFolder folder;
  const std::string path =
      folder.write("a.lst", "LST 0.1\nCylinder(0.5, 0.4, 3)\nMovRel3f(0, 3, 0)\nCylinder(0.4, 0.2, 1)\n");
  for (const std::string& scene : {path, folder.write("a.toml", "model.lst = 'a.lst'\n")}) {
    const Skeleton skeleton = make_skeleton(load_scene(scene));
    REQUIRE(skeleton.internodes.size() == 2);
    CHECK(skeleton.internodes[1].tip == Vec3(0, 4, 0));
    CHECK(skeleton.internodes[1].parent == 0);
  }
}

TEST_CASE("a mistake in a text within a scene is reported on the scene's line") {
  const ScratchFolder folder;
  const auto where_of = [&](const std::string& text) {
    try {
      make_model(load_scene(folder.write("a.toml", text)));
    } catch (const InputError& error) {
      return error.where();
    }
    return SourceLocation{};
  };
  const SourceLocation tree = where_of("version = 1\nmodel.tree = '''\ncone()\n  oops\n'''\n");
  CHECK_THAT(tree.file, Contains("a.toml"));
  CHECK(tree.line >= 4);
  const SourceLocation same_line = where_of("model.tree = 'nothing()'\n");
  CHECK(same_line.line == 1);
  CHECK(same_line.column == 15);
  const SourceLocation lsystem = where_of(
      "version = 1\nmodel.lsystem_text = '''\nLsystem: 1\nderivation length: 1\naxiom: A\nA --> )\nendlsystem\n'''\n");
  CHECK_THAT(lsystem.file, Contains("a.toml"));
  CHECK(lsystem.line == 6);
}

TEST_CASE("an L-system grows, is drawn and becomes a tree") {
  const ScratchFolder folder;
  const Scene scene = load_scene(folder.write("a.toml", R"(
[model]
lsystem_text = '''
#define N 3
Lsystem: 1
derivation length: N
axiom: !(0.2) A
A --> F(1)A
endlsystem
'''
[lsystem.defines]
N = 5
)"));
  CHECK(has_lsystem(scene));
  CHECK(to_string(grow(scene).word) == "!(0.2)F(1)F(1)F(1)F(1)F(1)A");
  const Model model = make_model(scene);
  REQUIRE(model.skeleton.internodes.size() == 5);
  CHECK(model.skeleton.internodes[4].tip == Vec3(0, 5, 0));
  CHECK(thinnest_radius(model) == Approx(0.1));
  CHECK(cell_size(scene, model) == Approx(0.05));
}

TEST_CASE("the thinnest radius follows the scales above a primitive") {
  CHECK(thinnest_radius(model_of_text("cone(base_radius = 0.5, tip_radius = 0.25)")) == 0.25);
  BlobTree tree;
  const NodeId ball = tree.add(Cone{{0, 0, 0}, {0, 0, 0}, 2, 2});
  const NodeId small = tree.add(Affine{Mat3(0.125), Vec3(0)}, {ball});
  const NodeId tapered = tree.add(Taper{{0, 0, 0}, {0, 1, 0}, 0.5}, {small});
  const NodeId ring = tree.add(Ring{{0, 0, 0}, {0, 1, 0}, 1, 0.2});
  tree.add(Sum{}, {tapered, ring});
  CHECK(thinnest_radius({{}, tree}) == Approx(0.125));
  CHECK(thinnest_radius(Model{}) == 0);
}

TEST_CASE("an empty model has no cell size unless the scene gives one") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.skel", "# barkridge skeleton 1\n");
  const Scene scene = load_scene(path);
  CHECK_THROWS_AS(cell_size(scene, make_model(scene)), InputError);
  const std::vector<Override> overrides = {parse_override("mesh.cell_size=0.5")};
  const Scene with_size = load_scene(path, overrides);
  CHECK(cell_size(with_size, make_model(with_size)) == 0.5);
}

TEST_CASE("a scene displaces thick branches, and its cells resolve the finest wavelength") {
  const ScratchFolder folder;
  folder.write("a.skel", kFork);
  const std::string path = folder.write("a.toml",
                                        "model.skeleton = 'a.skel'\n[displacement]\namount = 0.2\n"
                                        "wavelength = 0.08\noctaves = 3\nfurrowed_radius = 0.16\n");
  const Scene scene = load_scene(path);
  const Model model = make_model(scene);
  // The branches' mean radii are less than 0.55 of furrowed_radius.
  CHECK(std::count_if(model.tree.nodes.begin(), model.tree.nodes.end(),
                      [](const Node& node) { return std::holds_alternative<Displacement>(node.what); }) == 1);
  CHECK(cell_size(scene, model) == Approx(0.08 / 4 / 4));

  const Scene smooth = load_scene(path, std::vector{parse_override("displacement.amount=0")});
  CHECK(cell_size(smooth, make_model(smooth)) == Approx(0.04 / 2));
  CHECK(finest_wavelength(make_model(smooth).tree) == std::numeric_limits<double>::infinity());
}

TEST_CASE("a finest wavelength follows the scales above a displacement") {
  const Model model = model_of_text(
      "affine(linear = 0.5 0 0  0 1 0  0 0 1) { displacement(wavelength = 2, octaves = 2, stretch = 0.5) { cone() } }");
  CHECK(finest_wavelength(model.tree) == Approx(0.5 * 2 * 0.5 / 2));
}

TEST_CASE("statistics count what the root reaches") {
  const ScratchFolder folder;
  const ModelStatistics fork = statistics(make_model(load_scene(folder.write("a.skel", kFork))));
  CHECK(fork.internodes == 3);
  CHECK(fork.junctions == 1);
  CHECK(fork.primitives == 3);
  BlobTree tree;
  const NodeId a = tree.add(Cone{});
  tree.add(Disc{});
  const NodeId inner = tree.add(Sum{}, {a});
  tree.add(Union{}, {inner});
  const ModelStatistics chain = statistics({{}, tree});
  CHECK(chain.primitives == 1);
  CHECK(chain.tree_nodes == 3);
  CHECK(chain.tree_depth == 3);
}

TEST_CASE("a skeleton written as a table is the same skeleton when read") {
  const ScratchFolder folder;
  const Skeleton skeleton = make_skeleton(load_scene(folder.write("a.skel", kFork)));
  const std::string table = write_skeleton_table(skeleton);
  CHECK(table == kFork);
  CHECK(write_skeleton_table(make_skeleton(load_scene(folder.write("b.skel", table)))) == table);
}

TEST_CASE("a tree written by hand has no skeleton and nothing to grow") {
  const ScratchFolder folder;
  const Scene scene = load_scene(folder.write("a.toml", "model.tree = 'cone()'"));
  CHECK_THROWS_AS(make_skeleton(scene), InputError);
  CHECK_THROWS_AS(grow(scene), InputError);
}
