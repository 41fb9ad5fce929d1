#include <catch2/catch.hpp>

#include "base/error.h"
#include "cli/option_values.h"
#include "tests/cli/in_process.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Matchers::Contains;

namespace {

template <typename Verb>
Verb parse_as(const std::vector<std::string>& arguments) {
  return std::get<Verb>(std::get<cli::Command>(parse(arguments)).verb);
}

}  // namespace

TEST_CASE("options arrive where they belong") {
  const auto render = parse_as<cli::RenderArguments>({"render", "a.skel", "-o", "a.png", "--region", "3x4+5+6", "-q"});
  CHECK(render.path == "a.skel");
  CHECK(render.outputs == std::vector<std::string>{"a.png"});
  CHECK(render.region.width == 3);
  CHECK(render.region.height == 4);
  CHECK(render.region.x == 5);
  CHECK(render.region.y == 6);
  CHECK(render.quiet);
  CHECK(parse_as<cli::FieldArguments>({"field", "a.skel", "--points", "-"}).points == "-");
  CHECK(parse_as<cli::InfoArguments>({"info", "a.skel", "--json"}).json);
  CHECK(std::get<cli::Command>(parse({"mesh", "a.skel", "-o", "a.ply", "-t", "3"})).threads == 3);
  CHECK(std::get<cli::Command>(parse({"mesh", "a.skel", "-o", "a.ply"})).threads == 0);
}

TEST_CASE("options that stand for keys set them, over definitions, wherever they are written") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.toml", "model.tree = 'cone()'");
  const auto render = parse_as<cli::RenderArguments>({"render", "-Dimage.seed=1", "--define=sky.intensity=3", "--size",
                                                      "64x32", "--samples", "5", path, "--seed", "8", "-o", "a.png",
                                                      "-D", "junction.kind=smooth"});
  const Scene scene = load_scene(render.path, render.overrides);
  CHECK(scene.image.width == 64);
  CHECK(scene.image.height == 32);
  CHECK(scene.image.samples_per_pixel == 5);
  CHECK(scene.image.seed == 8);
  CHECK(scene.sky.intensity == 3);
  CHECK(scene.tree.junction == JunctionKind::kSmooth);
  const auto grow = parse_as<cli::GrowArguments>(
      {"grow", path, "--steps", "3", "--seed", "-4", "--max-modules", "5", "--max-memory", "2K"});
  const Scene grown = load_scene(grow.path, grow.overrides);
  CHECK(grown.derivation.steps == 3);
  CHECK(grown.derivation.seed == -4);
  CHECK(grown.derivation.max_modules == 5);
  CHECK(grown.derivation.max_memory == 2048);
  const auto mesh = parse_as<cli::MeshArguments>({"mesh", path, "-o", "a.ply", "--cell-size", "0.5"});
  CHECK(load_scene(mesh.path, mesh.overrides).cell_size == 0.5);
}

TEST_CASE("numbers of bytes may have a unit") {
  CHECK(cli::bytes_of("17") == 17u);
  CHECK(cli::bytes_of("2K") == 2048u);
  CHECK(cli::bytes_of("3M") == 3u << 20);
  CHECK(cli::bytes_of("4G") == std::uint64_t{4} << 30);
  for (const char* text : {"", "K", "-1", "2X", "2KB", "1.5G", "99999999999G", "99999999999999999999"}) {
    CAPTURE(text);
    CHECK_FALSE(cli::bytes_of(text));
  }
}

TEST_CASE("wrong values of options name the option and what it takes") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", "model.tree = 'cone()'");
  const auto check_option = [&](const std::string& verb, const std::vector<std::string>& options,
                                const std::string& message) {
    std::vector<std::string> arguments = {verb, scene};
    if (verb != "grow") arguments.insert(arguments.end(), {"-o", folder.path(verb == "render" ? "a.png" : "a.ply")});
    arguments.insert(arguments.end(), options.begin(), options.end());
    CAPTURE(options);
    CHECK_THROWS_AS(run_in_process(arguments), InputError);
    CHECK_THROWS_WITH(run_in_process(arguments), Contains(message));
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
