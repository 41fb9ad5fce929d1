// The comparison from the command line.

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/output_file.h"
#include "tests/cli/run_program.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using barkridge::test::ScratchFolder;
using Catch::Contains;

namespace {

constexpr const char* kFork =
    "# barkridge skeleton 1\n"
    "0 -1 0 0 0 0 1 0 0.1 0.1\n"
    "1 0 0 1 0 0.5 1.8 0 0.07 0.07\n"
    "2 0 0 1 0 -0.5 1.8 0 0.07 0.07\n";

}  // namespace

TEST_CASE("a study of a fork has every method at every resolution, and a page with it all") {
  const ScratchFolder folder;
  const std::string scene = folder.write("fork.skel", kFork), out = folder.path("out");
  const Finished study = run_program({"study", scene, "-o", out, "--turns", "1", "--places", "6", "-q"});
  CHECK(study.err == "");
  REQUIRE(study.status == 0);
  const auto report = nlohmann::json::parse(read_file(out + "/report.json"));
  const auto& rows = report["tables"]["measurements"];
  REQUIRE(rows.size() == 16);
  double last = 0;
  for (const auto& row : rows) {
    CAPTURE(row.dump());
    CHECK(row["model"] == "fork");
    CHECK(row["triangles"] > 0);
    CHECK(row["total s"] > 0);
    CHECK(row["peak MB"] > 5);
    // Finer settings of one method come nearer to its surface.
    const double error = row["error px (rms)"];
    const bool is_first = row["setting"] == "cells of 2 radii" || row["setting"] == "level 0";
    if (!is_first) CHECK(error < last);
    last = error;
  }
  CHECK(report["tables"]["headline"][0]["model"] == "fork");
  CHECK(report["tables"]["published"].size() == 6);
  CHECK(report["tables"]["joints"].size() == 28);
  const std::string page = read_file(out + "/report.html");
  CHECK_THAT(page, Contains("<svg") && Contains("data:image/png;base64,") && Contains("cells of 0.5 radii"));
  CHECK_THAT(read_file(out + "/measurements.csv"), Contains("fork,templates,level 3,3,"));
  CHECK_FALSE(std::filesystem::exists(out + "/run.json"));
}

TEST_CASE("a study of a tree written by hand is refused") {
  const ScratchFolder folder;
  const std::string scene =
      folder.write("ball.toml", "version = 1\n[model]\ntree = 'cone(base = 0 0 0, tip = 0 1 0)'\n");
  const Finished study = run_program({"study", scene, "-o", folder.path("out"), "--turns", "1", "-q"});
  CHECK(study.status == 2);
  CHECK_THAT(study.err, Contains("expected a model with a skeleton"));
}

TEST_CASE("mesh writes what it took, and needs one of its outputs") {
  const ScratchFolder folder;
  const std::string scene = folder.write("fork.skel", kFork), statistics = folder.path("s.json");
  REQUIRE(run_program({"mesh", scene, "--surface", "hull", "--level", "1", "--statistics", statistics, "-q"}).status ==
          0);
  const auto values = nlohmann::json::parse(read_file(statistics));
  CHECK(values["internodes"] == 3);
  CHECK(values["triangles"] == 4 * values["control_triangles"].get<int>());
  CHECK(values["crossing_limbs"] == 0);
  // A branch from the fork's third internode back through its second.
  const std::string crossing = folder.write("crossing.skel",
                                            "# barkridge skeleton 1\n"
                                            "0 -1 0 0 0 0 2 0 0.2 0.2\n"
                                            "1 0 0 2 0 0 6 0 0.2 0.2\n"
                                            "2 0 0 2 0 2 2 0 0.2 0.2\n"
                                            "3 2 2 2 0 -1 6 0 0.2 0.2\n");
  REQUIRE(run_program({"mesh", crossing, "--surface", "hull", "--statistics", statistics, "-q"}).status == 0);
  CHECK(nlohmann::json::parse(read_file(statistics))["crossing_limbs"] == 1);
  CHECK_THAT(run_program({"mesh", scene}).err, Contains("expected -o FILE, or --statistics FILE"));
}

TEST_CASE("every surface of a fork is a mesh and a picture") {
  const ScratchFolder folder;
  const std::string scene = folder.write("fork.skel", kFork);
  for (const char* const method : {"implicit", "templates", "hull", "cylinders", "leaf"}) {
    CAPTURE(method);
    const std::string mesh = folder.path("m.obj"), picture = folder.path("p.png");
    CHECK(run_program({"mesh", scene, "--surface", method, "--level", "1", "-o", mesh, "-q"}).status == 0);
    CHECK(run_program({"render", scene, "--surface", method, "-o", picture, "--size", "24x32", "-q"}).status == 0);
    CHECK(read_file(mesh).find("\nf ") != std::string::npos);
    if (method == std::string("implicit")) continue;
    CHECK(read_file(mesh).find("\nvt ") != std::string::npos);
    const std::string ply = folder.path("m.ply");
    for (const char* const limit : {"surface.limit=true", "surface.limit=false"}) {
      CHECK(run_program({"mesh", scene, "--surface", method, "--level", "1", "-D", limit, "-o", ply, "-q"}).status ==
            0);
      CHECK_THAT(read_file(ply), Contains("property int internode") && Contains("property float age"));
    }
  }
  const auto triangles_with = [&](const std::vector<std::string>& definitions) {
    const std::string statistics = folder.path("s.json");
    std::vector<std::string> arguments{"mesh",    scene, "--surface",    "templates",
                                       "--level", "4",   "--statistics", statistics};
    for (const std::string& definition : definitions) arguments.insert(arguments.end(), {"-D", definition});
    REQUIRE(run_program(arguments).status == 0);
    return nlohmann::json::parse(read_file(statistics))["triangles"].get<int>();
  };
  const int all = triangles_with({});
  CHECK(triangles_with({"surface.max_angle_degrees=20"}) < all / 2);
  CHECK(triangles_with({"surface.noise=0.002", "surface.tip=tapered", "surface.texture=cylindrical"}) > all / 2);
  CHECK_THAT(run_program({"mesh", scene, "--surface", "wood", "-o", folder.path("m.obj")}).err,
             Contains("surface.method: expected \"implicit\""));
}
