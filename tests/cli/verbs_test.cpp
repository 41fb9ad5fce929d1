#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/run_program.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge::test;
using Catch::Matchers::Contains;

namespace {

// Doubles the trunk in each step: 2^N internodes of length 1.
const char* const kLsystem =
    "#define N 3\n"
    "Lsystem: 1\n"
    "derivation length: N\n"
    "axiom: !(0.5)F(1)\n"
    "F(x) --> F(x)F(x)\n"
    "endlsystem\n";

const char* const kFork =
    "# barkridge skeleton 1\n"
    "0 -1 0 0 0 0 1 0 0.2 0.2\n"
    "1 0 0 1 0 0.5 2 0 0.1 0.05\n"
    "2 0 0 1 0 -0.5 2 0 0.1 0.05\n";

std::string succeed(const std::vector<std::string>& arguments, const std::string& input = "") {
  RunOptions options;
  options.input = input;
  const Finished finished = run_program(arguments, options);
  CAPTURE(finished.err);
  CHECK(finished.status == 0);
  CHECK(finished.err.empty());
  return finished.out;
}

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("grow prints the derived string") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.l", kLsystem);
  CHECK(succeed({"grow", path, "--steps", "0"}) == "!(0.5)F(1)\n");
  CHECK(succeed({"grow", path, "--steps", "2"}) == "!(0.5)F(1)F(1)F(1)F(1)\n");
  CHECK(succeed({"grow", path}) == succeed({"grow", path, "--steps", "3"}));
  CHECK(succeed({"grow", path, "-D", "lsystem.defines.N=1"}) == "!(0.5)F(1)F(1)\n");
  CHECK(succeed({"grow", folder.write("a.toml", "model.lsystem = 'a.l'\nlsystem.steps = 1\n")}) == "!(0.5)F(1)F(1)\n");
}

TEST_CASE("grow's seed decides the stochastic choice") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.l",
                                        "Lsystem: 1\nseed: 1\nderivation length: 40\naxiom: A\n"
                                        "A --> aA : 1\nA --> bA : 1\nendlsystem\n");
  const std::string first = succeed({"grow", path, "--seed", "5"});
  CHECK(succeed({"grow", path, "--seed", "5"}) == first);
  CHECK(succeed({"grow", path, "--seed", "6"}) != first);
  CHECK(succeed({"grow", path, "--seed", "1"}) == succeed({"grow", path}));
}

TEST_CASE("the skeleton is a table that reads back as itself") {
  const ScratchFolder folder;
  const std::string table = succeed({"skeleton", folder.write("a.l", kLsystem)});
  CHECK_THAT(table, Catch::StartsWith("# barkridge skeleton 1\n"));
  CHECK(count_lines(table) == 1 + 8);
  CHECK(succeed({"skeleton", folder.write("b.skel", table)}) == table);
  CHECK(succeed({"skeleton", folder.write("c.skel", kFork)}) == kFork);
}

TEST_CASE("a string that was grown and saved draws the same skeleton") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.l", kLsystem);
  const std::string grown = succeed({"grow", path});
  CHECK(succeed({"skeleton", folder.write("a.str", grown)}) == succeed({"skeleton", path}));
  CHECK(succeed({"skeleton", folder.write("a.lstring", grown)}) == succeed({"skeleton", path}));
}

TEST_CASE("field prints the reference field of a ball, and its gradient, at the points") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", "model.tree = 'cone(tip = 0 0 0)'");
  const std::string points = "# x y z\n\n0 0 0\n 1 0 0 # on the surface\n\t0 -0.5 0\r\n+1e0 1 1\n";
  const std::string out = succeed({"field", scene, "--points", "-"}, points);
  CHECK(succeed({"field", scene, "--points", folder.write("points.txt", points)}) == out);
  std::istringstream lines(out);
  std::vector<std::array<double, 7>> rows;
  for (std::array<double, 7> row; lines >> row[0] >> row[1] >> row[2] >> row[3] >> row[4] >> row[5] >> row[6];)
    rows.push_back(row);
  REQUIRE(rows.size() == 4);
  CHECK(count_lines(out) == 4);
  // The falloff of Wyvill at u = r / 2: 1 - 22/9 u^2 + 17/9 u^4 - 4/9 u^6.
  for (const auto& [x, y, z, f, gx, gy, gz] : rows) {
    const double v = (x * x + y * y + z * z) / 4;
    const double slope = (-22 + 34 * v - 12 * v * v) / 9 / 2;  // of the falloff by v, times dv/dx = x / 2
    CHECK(f == Approx(1 - 22. / 9 * v + 17. / 9 * v * v - 4. / 9 * v * v * v).epsilon(1e-14));
    CHECK(gx == Approx(slope * x).margin(1e-14));
    CHECK(gy == Approx(slope * y).margin(1e-14));
    CHECK(gz == Approx(slope * z).margin(1e-14));
  }
  CHECK_THAT(succeed({"field", scene, "--points", "-"}, "0.1 0 0\n"), Catch::StartsWith("0.10000000000000001 0 0 0."));
  CHECK(succeed({"field", scene, "--points", "-"}, "").empty());
}

TEST_CASE("field answers every one of many points in order") {
  const ScratchFolder folder;
  std::string points;
  for (int i = 0; i < 10000; ++i) points += std::to_string(i) + " 0 0\n";
  const std::string out = succeed({"field", folder.write("a.toml", "model.tree = 'cone()'"), "--points", "-"}, points);
  std::istringstream lines(out);
  std::string line;
  int count = 0;
  while (std::getline(lines, line)) {
    if (!Catch::startsWith(line, std::to_string(count) + " 0 0 ")) FAIL(line);
    ++count;
  }
  CHECK(count == 10000);
}

TEST_CASE("info counts, measures and names the scene") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.skel", kFork);
  const auto info = nlohmann::json::parse(succeed({"info", path, "--json"}));
  CHECK(info["modules"].is_null());
  CHECK(info["internodes"] == 3);
  CHECK(info["organs"] == 0);
  CHECK(info["dropped_internodes"] == 0);
  CHECK(info["junctions"] == 1);
  CHECK(info["primitives"] == 3);
  CHECK(info["tree_nodes"].get<int>() >= 5);
  CHECK(info["tree_depth"].get<int>() >= 3);
  CHECK(info["thinnest_radius"] == 0.05);
  CHECK(info["scene_hash"].get<std::string>().size() == 64);
  // A round cap at the base, two at the tips.
  CHECK(info["bounds"]["lo"][1].get<double>() == Approx(-0.2).margin(0.01));
  CHECK(info["bounds"]["hi"][1].get<double>() == Approx(2.05).margin(0.02));
  CHECK(info["memory"]["peak_resident_bytes"].get<double>() > 1e6);
  const std::string text = succeed({"info", path});
  CHECK_THAT(text, Contains("internodes") && Contains("bounds") && Contains(info["scene_hash"].get<std::string>()));
  CHECK(nlohmann::json::parse(succeed({"info", folder.write("a.l", kLsystem), "--json"}))["modules"] == 9);
}

TEST_CASE("info on an empty model has no bounds") {
  const ScratchFolder folder;
  const auto info =
      nlohmann::json::parse(succeed({"info", folder.write("a.skel", "# barkridge skeleton 1\n"), "--json"}));
  CHECK(info["internodes"] == 0);
  CHECK(info["bounds"].is_null());
}
