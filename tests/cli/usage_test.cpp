#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/version.h"
#include "tests/cli/in_process.h"
#include "tests/cli/run_program.h"

using namespace barkridge;
using Catch::Matchers::Contains;

TEST_CASE("the program says its version") {
  const Finished finished = run_program({"--version"});
  CHECK(finished.status == 0);
  CHECK(finished.err.empty());
  CHECK(finished.out == std::string("barkridge ") + version() + "\n");
}

TEST_CASE("help lists the verbs, and each verb explains its options") {
  const Finished all = run_program({"--help"});
  CHECK(all.status == 0);
  CHECK(all.err.empty());
  for (const std::string verb : {"render", "mesh", "grow", "skeleton", "field", "info"}) {
    CHECK_THAT(all.out, Contains("\n  " + verb + ' '));
    CHECK_THAT(help_of({verb, "--help"}),
               Contains("--define") && Contains("Exit status") && Contains(verb == "grow" ? "FILE" : "SCENE"));
  }
  CHECK_THAT(help_of({"render", "--help"}), Contains("--output") && Contains("--size") && Contains("--spp") &&
                                                Contains("--samples") && Contains("--seed") && Contains("--threads") &&
                                                Contains("--region"));
  CHECK_THAT(help_of({"mesh", "--help"}), Contains("--cell-size"));
  CHECK_THAT(help_of({"grow", "--help"}), Contains("--steps") && Contains("--max-modules") && Contains("--max-memory"));
  CHECK_THAT(help_of({"info", "-h"}), Contains("--json"));
}

TEST_CASE("help fits a terminal of 100 columns") {
  for (const std::string verb : {"render", "mesh", "grow", "skeleton", "field", "info"}) {
    const std::string help = help_of({verb, "--help"});
    for (std::size_t start = 0; start < help.size();) {
      const std::size_t end = help.find('\n', start);
      CHECK(end - start <= 100);
      start = end + 1;
    }
  }
}

TEST_CASE("help on keys lists what -D can set") {
  CHECK_THAT(help_of({"--help-keys"}), Contains("junction.kind = \"ridge\"") && Contains("camera.azimuth_degrees"));
}

TEST_CASE("wrong usage is bad input and names what is wrong") {
  CHECK_THROWS_WITH(parse({}), Contains("expected a verb"));
  CHECK_THROWS_WITH(parse({"paint"}), Contains("paint"));
  CHECK_THROWS_WITH(parse({"render"}), Contains("SCENE") && Contains("barkridge render --help"));
  CHECK_THROWS_WITH(parse({"render", "a.skel"}), Contains("--output"));
  CHECK_THROWS_WITH(parse({"info", "a.skel", "--fast"}), Contains("--fast"));
  CHECK_THROWS_WITH(parse({"info", "a.skel", "b.skel"}), Contains("b.skel"));
  CHECK_THROWS_WITH(parse({"field", "a.skel"}), Contains("--points"));
  CHECK_THROWS_WITH(parse({"info", "a.skel", "-D"}), Contains("--define: 1 required KEY=VALUE missing"));
  CHECK_THROWS_AS(parse({"paint"}), InputError);

  const Finished finished = run_program({"paint"});
  CHECK(finished.status == 2);
  CHECK(finished.out.empty());
  CHECK_THAT(finished.err, Catch::StartsWith("barkridge: ") && Contains("paint"));
}
