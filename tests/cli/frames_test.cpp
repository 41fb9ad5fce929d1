#include "cli/frames.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/output_file.h"
#include "tests/cli/in_process.h"
#include "tests/cli/run_program.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Matchers::Contains;

namespace {

const char* const kGrowing = R"(
[model]
lsystem_text = '''
Lsystem: 1
derivation length: 6
start: {srand(4);}
axiom: A(0)
A(n) --> F(1)[&(40+nran(0,5))B]/(137.5)A(n+1)
B --> F(0.8)+(10)B
endlsystem
'''
[growth]
tip_radius = 0.05
elongation_steps = 2
steps_per_frame = 0.25
[image]
width = 32
height = 48
samples_per_pixel = 1
[mesh]
cell_size = 0.08
)";

void succeed(const std::vector<std::string>& arguments) {
  const Finished finished = run_program(arguments);
  INFO(finished.err);
  CHECK(finished.status == 0);
}

}  // namespace

TEST_CASE("ranges of frames are one number, two, or two and a step") {
  const auto range = [](const char* text) {
    const auto r = cli::frame_range_of(text);
    return r ? std::vector<int>{r->first, r->last, r->step} : std::vector<int>{};
  };
  CHECK(range("7") == std::vector<int>{7, 7, 1});
  CHECK(range("0-100") == std::vector<int>{0, 100, 1});
  CHECK(range("3-20:5") == std::vector<int>{3, 20, 5});
  for (const char* text :
       {"", "-", "5-", "-5", "5-4", "1-2:0", "1-2:-1", "1:2", "1-2-3", "a", "1-2:3:4", "0-1000001"}) {
    CAPTURE(text);
    CHECK(range(text).empty());
  }
}

TEST_CASE("a frame's number stands where the name has its place") {
  CHECK(cli::frame_path("a/tree_####.png", 17) == "a/tree_0017.png");
  CHECK(cli::frame_path("tree_%04d.png", 17) == "tree_0017.png");
  CHECK(cli::frame_path("tree_%d.png", 17) == "tree_17.png");
  CHECK(cli::frame_path("tree_%3d.png", 5) == "tree_005.png");
  CHECK(cli::frame_path("#.png", 12345) == "12345.png");
  CHECK(cli::frame_path("a#b/100%_##.png", 3) == "a#b/100%_03.png");
  for (const char* pattern : {"tree.png", "a##/tree.png", "#_#.png", "#_%d.png", "100%.png", "%99d.png", "%x.png"}) {
    CAPTURE(pattern);
    CHECK_FALSE(cli::frame_path(pattern, 1));
  }
}

TEST_CASE("a picture or mesh made alone is the same to the byte as among others, at frames on and between steps") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kGrowing);
  for (const std::string verb : {"render", "mesh"}) {
    const std::string extension = verb == "render" ? ".png" : ".ply";
    succeed({verb, scene, "--frames", "5-20:3", "-o", folder.path("s_###" + extension)});
    for (const char* number : {"005", "008", "011", "020"}) {
      const std::string alone = folder.path("alone" + extension);
      succeed({verb, scene, "--frames", std::to_string(std::stoi(number)), "-o", alone});
      CAPTURE(number);
      CHECK(read_file(alone) == read_file(folder.path(std::string("s_") + number + extension)));
    }
    succeed({verb, scene, "-D", "growth.time=2", "-o", folder.path("time" + extension)});
    CHECK(read_file(folder.path("time" + extension)) == read_file(folder.path("s_008" + extension)));
    CHECK(read_file(folder.path("s_005" + extension)) != read_file(folder.path("s_008" + extension)));
  }
  // Two sequences of six, two files alone, two at a time, and the scene.
  CHECK(folder.entries() == 17);
}

TEST_CASE("several frames need a place for their number, and plants that can grow") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kGrowing);
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    CHECK_THROWS_AS(run_in_process(arguments), InputError);
    CHECK_THROWS_WITH(run_in_process(arguments), Contains(message));
  };
  refused({"render", scene, "--frames", "1-2", "-o", folder.path("a.png")}, "expected one place for the number");
  refused({"mesh", scene, "--frames", "1-2", "-o", folder.path("##.ply"), "-o", folder.path("a.obj")}, "a.obj");
  refused({"mesh", scene, "--frames", "2-1", "-o", folder.path("##.ply")}, "--frames 2-1: expected numbers of frames");
  refused({"render", scene, "--frames", "1000000", "-D", "growth.steps_per_frame=1", "-o", folder.path("a.png")},
          "expected at most 65535");
  const std::string tree = folder.write("b.toml", "model.tree = 'cone()'");
  refused({"render", tree, "--frames", "1", "-o", folder.path("a.png")}, "expected an L-system");
  refused({"render", tree, "-D", "growth.time=1", "-o", folder.path("a.png")}, "growth.time: expected an L-system");
  CHECK(folder.entries() == 2);
}

TEST_CASE("a bar says which of the frames is being made") {
  if (!has_terminals()) {
    WARN("this machine has no pseudo-terminals, so the bar is not looked at");
    return;
  }
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kGrowing);
  const Finished seen = run_program_on_terminal({"render", scene, "--frames", "1-3", "-o", folder.path("#.png")});
  CHECK_THAT(seen.err, Contains("frame 2 of 3: rendering"));
}
