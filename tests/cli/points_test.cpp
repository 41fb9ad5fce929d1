#include "cli/points.h"

#include <catch2/catch.hpp>

#include "base/error.h"

using namespace barkridge;
using Catch::Matchers::Contains;

TEST_CASE("a point is three numbers, with blanks and comments around them") {
  CHECK(cli::parse_point("1 -2.5 3e2", "f", 1) == Vec3(1, -2.5, 300));
  CHECK(cli::parse_point("\t+1  2\t3 \r", "f", 1) == Vec3(1, 2, 3));
  CHECK(cli::parse_point("1 2 3# surface", "f", 1) == Vec3(1, 2, 3));
  CHECK(cli::parse_point("0.1 0 0", "f", 1) == Vec3(0.1, 0, 0));
  for (const char* blank : {"", "  \t\r", "# 1 2 3", "   # x y z"}) CHECK_FALSE(cli::parse_point(blank, "f", 1));
}

TEST_CASE("a line that is no point is refused with its place") {
  const auto message_of = [](const char* line) {
    try {
      cli::parse_point(line, "points", 7);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(message_of("0 0"), Contains("points:7:4: expected three numbers x y z, not 2"));
  CHECK(message_of("0 0 zero") == "points:7:5: expected a finite number, not zero\n  0 0 zero\n      ^");
  CHECK_THAT(message_of("0 nan 0"), Contains("points:7:3: expected a finite number, not nan"));
  CHECK_THAT(message_of("0 0 -inf"), Contains("expected a finite number, not -inf"));
  CHECK_THAT(message_of("0 0 1e999"), Contains("expected a finite number, not 1e999"));
  CHECK_THAT(message_of("1,2,3"), Contains("not 1,2,3"));
  CHECK_THAT(message_of("1 2 3 4"), Contains("points:7:7: expected the end of the line after x y z"));
  CHECK_THAT(message_of("+-1 2 3"), Contains("not +-1"));
}
