#include <catch2/catch.hpp>

#include "base/version.h"
#include "mesh/mesh.h"
#include "tests/cli/run_program.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge::test;
using barkridge::read_file;
using Catch::Matchers::Contains;

namespace {

const char* const kFork =
    "# barkridge skeleton 1\n"
    "0 -1 0 0 0 0 1 0 0.2 0.2\n"
    "1 0 0 1 0 0.5 2 0 0.1 0.1\n"
    "2 0 0 1 0 -0.5 2 0 0.1 0.1\n";

void succeed(const std::vector<std::string>& arguments) {
  const Finished finished = run_program(arguments);
  CAPTURE(finished.err);
  CHECK(finished.status == 0);
  CHECK(finished.out.empty());
  CHECK(finished.err.empty());
}

void render(const std::string& scene, const std::string& output, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"render", scene, "-o", output, "--size", "48x64", "--spp", "4"});
  succeed(options);
}

}  // namespace

TEST_CASE("pictures are the same bytes for one thread and for two") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", kFork);
  for (const char* extension : {".exr", ".png"}) {
    const std::string one = folder.path(std::string("one") + extension),
                      two = folder.path(std::string("two") + extension);
    render(scene, one, {"-t", "1"});
    render(scene, two, {"-t", "2"});
    CHECK(read_file(one) == read_file(two));
  }
  CHECK(read_file(folder.path("one.exr")).substr(0, 4) == "\x76\x2f\x31\x01");
  CHECK(read_file(folder.path("one.png")).substr(0, 8) == "\x89PNG\r\n\x1a\n");
}

TEST_CASE("several outputs of one run are the same as one a run") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", kFork);
  render(scene, folder.path("a.exr"));
  render(scene, folder.path("b.exr"), {"-o", folder.path("b.png")});
  CHECK(read_file(folder.path("a.exr")) == read_file(folder.path("b.exr")));
  succeed({"mesh", scene, "-o", folder.path("a.ply"), "-o", folder.path("a.obj"), "--cell-size", "0.1"});
  CHECK(read_file(folder.path("a.ply")).substr(0, 4) == "ply\n");
  CHECK(read_file(folder.path("a.obj")).find("\nf ") != std::string::npos);
}

TEST_CASE("a picture's header has version, scene hash and seed, and not its own name") {
  const ScratchFolder folder;
  const std::string scene = folder.write("secret.skel", kFork);
  const std::string hash = run_program({"info", scene}).out.substr(20, 64);
  render(scene, folder.path("hidden.exr"), {"--seed", "4711"});
  const std::string header = read_file(folder.path("hidden.exr")).substr(0, 4000);
  CHECK_THAT(header, Contains(barkridge::version()) && Contains(hash));
  CHECK_THAT(header, !Contains("hidden") && !Contains("secret"));
}

TEST_CASE("seeds, scenes and overrides change the picture") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", kFork);
  render(scene, folder.path("a.png"));
  const std::string picture = read_file(folder.path("a.png"));
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"-D", "camera.azimuth_degrees=60"},
                                             {"-D", "sky.intensity=0.25"},
                                             {"-D", "ground.enabled=false"},
                                             {"-D", "material.color=[1,0,0]"}}) {
    render(scene, folder.path("b.png"), options);
    CAPTURE(options.back());
    CHECK(read_file(folder.path("b.png")) != picture);
  }
}

TEST_CASE("meshes are the same bytes for one thread and for two, in every format") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", kFork);
  for (const char* extension : {".ply", ".obj", ".stl"}) {
    const std::string one = folder.path(std::string("one") + extension),
                      two = folder.path(std::string("two") + extension);
    succeed({"mesh", scene, "-o", one, "-t", "1"});
    succeed({"mesh", scene, "-o", two, "-t", "2"});
    CHECK(read_file(one) == read_file(two));
  }
  CHECK_THAT(read_file(folder.path("one.ply")), Catch::StartsWith("ply\nformat binary_little_endian 1.0\n"));
}

TEST_CASE("a finer cell makes more triangles, and none given follows the thinnest radius") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", kFork);
  const auto size = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"mesh", scene, "-o", folder.path("a.stl")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    succeed(arguments);
    return read_file(folder.path("a.stl")).size();
  };
  CHECK(size({"--cell-size", "0.05"}) > size({"--cell-size", "0.1"}));
  // Half the radius of 0.1.
  CHECK(size({}) == size({"--cell-size", "0.05"}));
  CHECK(size({"-D", "mesh.cell_size=0.1"}) == size({"--cell-size", "0.1"}));
}

TEST_CASE("an output with an unknown extension is refused before anything is done") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", kFork);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"render", scene, "-o", folder.path("a.ply")},
                                             {"mesh", scene, "-o", folder.path("a.png")},
                                             {"render", scene, "-o", folder.path("a")}}) {
    const Finished finished = run_program(arguments);
    CHECK(finished.status == 2);
    CHECK_THAT(finished.err, Contains(arguments.back()));
  }
  CHECK(folder.entries() == 1);
}

TEST_CASE("a progress bar with the time left appears on a terminal only") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", kFork);
  const std::vector<std::string> arguments = {"render", scene, "-o", folder.path("a.png"), "--size", "96x128"};
  CHECK(run_program(arguments).err.empty());
  if (!has_terminals()) {
    WARN("this machine has no pseudo-terminals, so the bar itself is not looked at");
    return;
  }
  const Finished seen = run_program_on_terminal(arguments);
  CHECK(seen.status == 0);
  CHECK_THAT(seen.err, Contains("rendering") && Contains("%"));
  std::vector<std::string> quiet = arguments;
  quiet.push_back("--quiet");
  CHECK(run_program_on_terminal(quiet).err.empty());
}
