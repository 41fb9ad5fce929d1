#include <catch2/catch.hpp>

#include "base/version.h"
#include "tests/cli/run_program.h"

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
