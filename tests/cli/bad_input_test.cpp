#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/cli/in_process.h"
#include "tests/cli/run_program.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Matchers::Contains;

namespace {

// Writes `content`, gives it to `info`, and expects refusal with a message that has the place and the words.
void check_refused(const std::string& name, const std::string& content, const std::string& place,
                   const std::string& words) {
  const ScratchFolder folder;
  const std::string path = folder.write(name, content);
  CAPTURE(content);
  CHECK_THROWS_AS(run_in_process({"info", path}), InputError);
  CHECK_THROWS_WITH(run_in_process({"info", path}), Contains(path + place) && Contains(words));
}

const std::string kTable = "# barkridge skeleton 1\n";

}  // namespace

TEST_CASE("numbers that are not finite are refused in every kind of input") {
  check_refused("a.skel", kTable + "0 -1 0 0 nan 0 1 0 0.1 0.1\n", ":2:10: ", "nan");
  check_refused("a.skel", kTable + "0 -1 0 0 0 0 inf 0 0.1 0.1\n", ":2:14: ", "inf");
  check_refused("a.toml", "model.tree = 'cone()'\nsky.intensity = nan\n",
                ":2:17: ", "sky.intensity: expected a finite number");
  check_refused("a.toml", "model.tree = 'cone(tip = 0 inf 0)'\n", ":1:", "finite");
}

TEST_CASE("radii that are zero or negative are refused in every kind of input") {
  check_refused("a.skel", kTable + "0 -1 0 0 0 0 1 0 0 0.1\n", ":2:", "radi");
  check_refused("a.skel", kTable + "0 -1 0 0 0 0 1 0 0.1 -0.1\n", ":2:", "radi");
  check_refused("a.toml", "model.tree = 'cone(base_radius = 0)'\n", ":1:", "radius");
  check_refused("a.toml", "model.tree = 'ring(radius = -1)'\n", ":1:", "radius");
  check_refused("a.str", "!(0)F(1)", "", "width");
}

TEST_CASE("unknown keys are refused with a suggestion") {
  check_refused("a.toml", "model.tree = 'cone()'\n[junction]\nkid = 'ridge'\n",
                ":3:1: ", "unknown key junction.kid; did you mean junction.kind?");
}

TEST_CASE("brackets without a partner are refused in every kind of input") {
  check_refused("a.str", "F(1)[+F(1)", ":1:5: ", "");
  check_refused("a.str", "F(1)]F(1)", ":1:5: ", "");
  check_refused("a.l", "Lsystem: 1\nderivation length: 0\naxiom: F[F\nF --> F\nendlsystem\n", "", "[");
  check_refused("a.toml", "model.tree = 'sum {'\n", ":1:", "");
  check_refused("a.toml", "model.tree = 'cone()'\ncamera.position = [1, 2\n", ":", "");
}

TEST_CASE("tables of skeletons that make no sense are refused") {
  check_refused("a.skel", "0 -1 0 0 0 0 1 0 0.1 0.1\n", ":1:", "barkridge skeleton 1");
  check_refused("a.skel", kTable + "0 -1 0 0 0 0 1 0 0.1\n", ":2:", "");
  check_refused("a.skel", kTable + "0 7 0 0 0 0 1 0 0.1 0.1\n", ":2:", "parent");
  check_refused("a.skel", kTable + "0 -1 0 0 0 0 1 0 0.1 0.1\n0 -1 0 0 0 0 1 0 0.1 0.1\n", ":3:", "");
}

TEST_CASE("mistakes in a text within a scene have the scene's line, and a caret below the place") {
  const ScratchFolder folder;
  const Finished finished =
      run_program({"info", folder.write("a.toml", "[model]\ntree = '''\nsum {\n  cone(radius = 1)\n}'''\n")});
  CHECK(finished.status == 2);
  CHECK_THAT(finished.err, Contains("a.toml:4:8: ") && Contains("\n    cone(radius = 1)\n         ^\n"));
}

TEST_CASE("scenes that are missing or of no known kind are bad input") {
  const ScratchFolder folder;
  for (const char* name : {"none.toml", "none.l", "none.skel", "none.obj", "none"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(run_in_process({"info", folder.path(name)}), InputError);
    CHECK_THROWS_WITH(run_in_process({"info", folder.path(name)}), Contains(folder.path(name)));
  }
  CHECK(run_program({"info", folder.path("none.toml")}).status == 2);
}

TEST_CASE("points that are no points are refused with their place") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", "model.tree = 'cone()'");
  RunOptions options;
  options.input = "0 0 0\n0 0\n";
  const Finished finished = run_program({"field", scene, "--points", "-"}, options);
  CHECK(finished.status == 2);
  CHECK_THAT(finished.err, Contains("standard input:2:4: expected three numbers x y z, not 2\n  0 0\n     ^\n"));
  const Finished missing = run_program({"field", scene, "--points", folder.path("none.txt")});
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, Contains("none.txt"));
}

TEST_CASE("verbs refuse models that have not what they need") {
  const ScratchFolder folder;
  const std::string tree = folder.write("a.toml", "model.tree = 'cone()'");
  const std::string empty = folder.write("a.skel", kTable);
  CHECK_THROWS_WITH(run_in_process({"skeleton", tree}), Contains("expected a model with a skeleton"));
  CHECK_THROWS_WITH(run_in_process({"grow", empty}), Contains("expected an L-system"));
  CHECK_THROWS_WITH(run_in_process({"mesh", empty, "-o", folder.path("a.ply")}), Contains("mesh.cell_size"));
}

TEST_CASE("growth beyond its limits is refused, naming the limit") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.l", "Lsystem: 1\nderivation length: 60\naxiom: A\nA --> AA\nendlsystem\n");
  const Finished modules = run_program({"grow", path, "--max-modules", "1000"});
  CHECK(modules.status == 2);
  CHECK_THAT(modules.err, Contains("1000"));
  const Finished memory = run_program({"grow", path, "--max-memory", "1M"});
  CHECK(memory.status == 2);
  CHECK(memory.out.empty());
}
