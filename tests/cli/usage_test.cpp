#include <catch2/catch.hpp>

#include "base/version.h"
#include "tests/cli/run_program.h"
#include "tests/scene/scratch_folder.h"

using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> kVerbs = {"render", "mesh", "grow", "skeleton", "field", "info"};

void check_usage_error(const std::vector<std::string>& arguments, const std::string& message) {
  const Finished finished = run_program(arguments);
  CHECK(finished.status == 2);
  CHECK(finished.out.empty());
  CHECK_THAT(finished.err, Contains("barkridge: ") && Contains(message));
}

}  // namespace

TEST_CASE("--version says the version") {
  const Finished finished = run_program({"--version"});
  CHECK(finished.status == 0);
  CHECK(finished.out == std::string("barkridge ") + barkridge::version() + "\n");
}

TEST_CASE("--help lists the verbs, and each verb explains its options") {
  const Finished all = run_program({"--help"});
  CHECK(all.status == 0);
  CHECK(all.err.empty());
  for (const std::string& verb : kVerbs) {
    CHECK_THAT(all.out, Contains(verb));
    const Finished one = run_program({verb, "--help"});
    CAPTURE(verb);
    CHECK(one.status == 0);
    CHECK_THAT(one.out, Contains("--define") && Contains("Exit status") && Contains(verb == "grow" ? "FILE" : "SCENE"));
  }
  CHECK_THAT(run_program({"render", "--help"}).out, Contains("--output") && Contains("--size") && Contains("--spp") &&
                                                        Contains("--samples") && Contains("--seed") &&
                                                        Contains("--threads") && Contains("--region"));
  CHECK_THAT(run_program({"mesh", "--help"}).out, Contains("--cell-size"));
  CHECK_THAT(run_program({"grow", "--help"}).out,
             Contains("--steps") && Contains("--max-modules") && Contains("--max-memory"));
}

TEST_CASE("--help-keys lists what -D can set") {
  const Finished finished = run_program({"--help-keys"});
  CHECK(finished.status == 0);
  CHECK_THAT(finished.out, Contains("junction.kind = \"ridge\"") && Contains("camera.azimuth_degrees"));
}

TEST_CASE("wrong usage is told apart from failure and names what is wrong") {
  check_usage_error({}, "verb");
  check_usage_error({"paint"}, "paint");
  check_usage_error({"render"}, "SCENE");
  check_usage_error({"render", "a.skel"}, "--output");
  check_usage_error({"info", "a.skel", "--fast"}, "--fast");
  check_usage_error({"info", "a.skel", "b.skel"}, "b.skel");
  check_usage_error({"field", "a.skel"}, "--points");
  check_usage_error({"info", "a.skel", "-D"}, "--define: 1 required KEY=VALUE missing");
}

TEST_CASE("wrong values of options name the option and what it takes") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", "model.tree = 'cone()'");
  const auto check_option = [&](const std::string& verb, std::vector<std::string> options, const std::string& message) {
    std::vector<std::string> arguments = {verb, scene};
    if (verb != "grow") arguments.insert(arguments.end(), {"-o", folder.path(verb == "render" ? "a.png" : "a.ply")});
    arguments.insert(arguments.end(), options.begin(), options.end());
    check_usage_error(arguments, message);
  };
  check_option("render", {"--size", "640"}, "--size 640: expected width and height in pixels, like 768x1024");
  check_option("render", {"--size", "0x10"}, "--size 0x10: image.width: expected an integer from 1 to 65536, not 0");
  check_option("render", {"--size", "10x-3"}, "--size 10x-3");
  check_option("render", {"--size", "99999999999x3"}, "--size 99999999999x3");
  check_option("render", {"--spp", "0"},
               "--spp 0: image.samples_per_pixel: expected an integer from 1 to 65536, not 0");
  check_option("render", {"--samples", "many"}, "many");
  check_option("render", {"--seed", "-1"}, "--seed -1: image.seed: expected an integer of at least 0");
  check_option("render", {"--region", "10x10"}, "--region 10x10: expected width, height and place in pixels");
  check_option("render", {"--region", "0x10+0+0"}, "--region 0x10+0+0");
  check_option("render", {"--size", "64x64", "--region", "32x32+40+0"},
               "expected a part of the picture, which has 64 x 64 pixels");
  check_option("render", {"--size", "64x64", "--region", "2147483647x1+2147483647+0"},
               "expected a part of the picture");
  check_option("render", {"-t", "-2"}, "--threads");
  check_option("render", {"-t", "two"}, "two");
  check_option("mesh", {"--cell-size", "0"}, "--cell-size 0: mesh.cell_size: expected a finite number above 0, not 0");
  check_option("mesh", {"--cell-size", "nan"}, "--cell-size nan");
  check_option("mesh", {"--cell-size", "-1"}, "--cell-size -1");
  check_option("grow", {"--steps", "-1"}, "--steps -1: lsystem.steps: expected an integer from 0");
  check_option("grow", {"--steps", "1.5"}, "--steps 1.5");
  check_option("grow", {"--max-modules", "0"}, "--max-modules 0");
  check_option("grow", {"--max-memory", "2X"}, "--max-memory 2X: expected a number of bytes, like 500000000 or 2G");
  check_option("grow", {"-D", "junction.kind"}, "-D junction.kind: expected key=value");
  check_option("mesh", {"-D", "junction.kind=round"},
               "-D junction.kind=round: junction.kind: expected \"ridge\" or \"smooth\"");
}
