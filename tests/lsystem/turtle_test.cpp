#include <catch2/catch.hpp>

#include <cmath>

#include "base/error.h"
#include "lsystem/turtle.h"
#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

namespace {

Skeleton drawn(const std::string& text, const TurtleOptions& options = {}) {
  return interpret(parse_word(text, "test.str"), nullptr, options);
}

void check_close(const Vec3& actual, const Vec3& expected) {
  INFO(actual.x << ", " << actual.y << ", " << actual.z);
  CHECK(glm::length(actual - expected) < 1e-6);
}

/// The frame after `text`, which begins at heading +y, left -x, up +z.
Organ frame(const std::string& text, const TurtleOptions& options = {}) {
  return drawn(text + "@O(1)", options).organs.back();
}

}  // namespace

TEST_CASE("a segment goes from where the turtle was to where it is") {
  const Skeleton skeleton = drawn("F(2)+(90)F(3)");
  REQUIRE(skeleton.internodes.size() == 2);
  check_close(skeleton.internodes[0].base, {0, 0, 0});
  check_close(skeleton.internodes[0].tip, {0, 2, 0});
  check_close(skeleton.internodes[1].tip, {-3, 2, 0});
}

TEST_CASE("a turn of 90 degrees takes one axis of the frame to another") {
  const Vec3 heading(0, 1, 0), left(-1, 0, 0), up(0, 0, 1);
  struct Turn {
    const char* command;
    Vec3 heading, left, up;
  };
  const Turn turns[] = {
      {"+(90)", left, -heading, up}, {"-(90)", -left, heading, up},  {"&(90)", -up, left, heading},
      {"^(90)", up, left, -heading}, {"/(90)", heading, -up, left},  {"\\(90)", heading, up, -left},
      {"|", -heading, -left, up},    {"+(-90)", -left, heading, up},
  };
  for (const Turn& turn : turns) {
    INFO(turn.command);
    const Organ after = frame(turn.command);
    check_close(after.heading, turn.heading);
    check_close(after.left, turn.left);
    check_close(after.up, turn.up);
  }
}

TEST_CASE("frames stay right-handed and orthonormal") {
  const Organ after = frame("+(12)&(34)/(56)-(78)^(9)\\(10)|F@v+(20)@R(1,2,3)&(5)");
  check_close(glm::cross(after.heading, after.left), after.up);
  CHECK(glm::length(after.heading) == Approx(1));
  CHECK(std::abs(glm::dot(after.heading, after.left)) < 1e-12);
}

TEST_CASE("defaults come from the options") {
  TurtleOptions options;
  options.angle_increment_degrees = 90;
  options.step = 2;
  options.line_width = 0.5;
  options.initial_scale = 3;
  const Skeleton skeleton = drawn("+F", options);
  check_close(skeleton.internodes[0].tip, {-6, 0, 0});
  CHECK(skeleton.internodes[0].base_radius == 0.5);  // the initial width is scaled by the step, as in cpfg
}

TEST_CASE("the tip's width is set by what stands before the next end of a segment") {
  const Skeleton skeleton = drawn("!(3)F#(2)F");
  REQUIRE(skeleton.internodes.size() == 2);
  CHECK(skeleton.internodes[0].base_radius == 1.5);
  CHECK(skeleton.internodes[0].tip_radius == 1);
  CHECK(skeleton.internodes[1].base_radius == 1);
  CHECK(skeleton.internodes[1].tip_radius == 1);
}

TEST_CASE("every command that ends a node fixes the tip's width") {
  for (const std::string end :
       {"F", "G", "f", "g", "[]", "{}", "~l", "@O", "@v", "@M(0,9)", "@Gs", "@#(1)", "@,", "."}) {
    INFO(end);
    CHECK(drawn("!(4)F" + end + "!(2)F").internodes[0].tip_radius == 2);
  }
  for (const std::string other : {"+", "&", "/", "|", ";", ",", "%", "A", "_", "F(0)"}) {
    INFO(other);
    const double tip = other == "F(0)" ? 2 : 1;  // a segment without length ends the one before it all the same
    CHECK(drawn("!(4)F" + other + "!(2)F").internodes[0].tip_radius == tip);
  }
}

TEST_CASE("a branch ends the segment before it with the width at its bracket") {
  const Skeleton skeleton = drawn("!(4)F[!(2)F!(1)]!(3)F!(2)");
  REQUIRE(skeleton.internodes.size() == 3);
  CHECK(skeleton.internodes[0].tip_radius == 2);
  CHECK(skeleton.internodes[1].base_radius == 1);
  CHECK(skeleton.internodes[1].tip_radius == 0.5);
  CHECK(skeleton.internodes[2].base_radius == 1.5);
  CHECK(skeleton.internodes[2].tip_radius == 1);
}

TEST_CASE("lines that are not tapered keep their width") {
  TurtleOptions options;
  options.tapered_lines = false;
  CHECK(drawn("!(3)F#(2)F", options).internodes[0].tip_radius == 1.5);
}

TEST_CASE("width increments are scaled and stop at 1e-7, as does a tip of width 0") {
  TurtleOptions options;
  options.line_width = 4;
  options.line_width_increment = 1;
  const Skeleton skeleton = drawn("F!F##F", options);
  CHECK(skeleton.internodes[0].tip_radius == 1.5);
  CHECK(skeleton.internodes[1].base_radius == 1.5);
  CHECK(skeleton.internodes[2].base_radius == 2.5);
  CHECK(drawn("!!!!!F", options).internodes[0].base_radius == 0.5e-7);
  CHECK(drawn("F!(0)").internodes[0].tip_radius == 0.5e-7);
  CHECK(drawn("@D(2)!F", options).internodes[0].base_radius == 1);
  CHECK(drawn("F!F").internodes[1].base_radius == 0.5);  // the increment is 0 by default
}

TEST_CASE("scale multiplies lengths and widths") {
  TurtleOptions options;
  options.scale_multiplier = 4;
  const Skeleton skeleton = drawn("@D(2)!(3)F(5)@Di(3)F@Dd(6)F@DiF@DdF", options);
  CHECK(skeleton.internodes[0].tip.y == 10);
  CHECK(skeleton.internodes[0].base_radius == 3);
  CHECK(skeleton.internodes[1].tip.y == 16);
  CHECK(skeleton.internodes[2].tip.y == 17);
  CHECK(skeleton.internodes[3].tip.y == 21);
  CHECK(skeleton.internodes[4].tip.y == 22);
  CHECK(drawn("F[@D(3)F]F").internodes[2].tip.y == 2);
}

TEST_CASE("parents are the segments before, across brackets, and orders count branches") {
  const Skeleton skeleton = drawn("F[+F[[-F]F]]F[^F]");
  REQUIRE(skeleton.internodes.size() == 6);
  const std::vector<int> parents{-1, 0, 1, 1, 0, 4};
  const std::vector<int> orders{0, 1, 2, 2, 0, 1};
  for (std::size_t i = 0; i < parents.size(); ++i) {
    CHECK(skeleton.internodes[i].parent == parents[i]);
    CHECK(skeleton.internodes[i].order == orders[i]);
  }
}

TEST_CASE("branches without a trunk are roots") {
  const Skeleton skeleton = drawn("[F]f[FF]");
  const std::vector<int> parents{-1, -1, 1};
  for (std::size_t i = 0; i < parents.size(); ++i) {
    CHECK(skeleton.internodes[i].parent == parents[i]);
    CHECK(skeleton.internodes[i].order == 0);
  }
}

TEST_CASE("a move leaves a gap but keeps the parent") {
  const Skeleton skeleton = drawn("Ff(2)F[fF]@M(7,8,9)F");
  REQUIRE(skeleton.internodes.size() == 4);
  check_close(skeleton.internodes[1].base, {0, 3, 0});
  CHECK(skeleton.internodes[1].parent == 0);
  CHECK(skeleton.internodes[2].parent == 1);
  CHECK(skeleton.internodes[2].order == 1);
  check_close(skeleton.internodes[3].base, {7, 8, 9});
  CHECK(skeleton.internodes[3].parent == 1);
}

TEST_CASE("segments of zero length are dropped and counted") {
  const Skeleton skeleton = drawn("F(0)F[F(0)F]F(0)F");
  REQUIRE(skeleton.internodes.size() == 3);
  CHECK(skeleton.dropped_internodes == 3);
  CHECK(skeleton.internodes[0].parent == -1);
  CHECK(skeleton.internodes[1].parent == 0);
  CHECK(skeleton.internodes[1].order == 1);
  CHECK(skeleton.internodes[2].parent == 0);
  CHECK(skeleton.internodes[2].order == 0);
}

TEST_CASE("straight chains are not merged and negative lengths go back") {
  CHECK(drawn("FFFF").internodes.size() == 4);
  check_close(drawn("F(2)F(-1)").internodes[1].tip, {0, 1, 0});
}

TEST_CASE("@v turns the turtle's up nearest to the vertical") {
  const Organ rolled = frame("-(90)/(77)@v");
  check_close(rolled.heading, {1, 0, 0});
  check_close(rolled.up, {0, 1, 0});
  const Organ slanted = frame("&(30)/(123)@v");
  CHECK(std::abs(slanted.left.y) < 1e-12);
  CHECK(slanted.up.y == Approx(0.5));  // the heading leaves the vertical by 30 degrees
  const Organ vertical = frame("/(40)@v");
  check_close(vertical.left, frame("/(40)").left);
}

TEST_CASE("@R sets the heading, with cpfg's up if it is perpendicular") {
  check_close(frame("@R(1,0)").heading, {1, 0, 0});
  check_close(frame("@R(0,0,2)").heading, {0, 0, 1});
  check_close(frame("@R(0,0,0)").heading, {0, 1, 0});
  const Organ full = frame("@R(1,0,0,0,0,-1)");  // the stored up is the negative one
  check_close(full.up, {0, 0, 1});
  check_close(full.left, {0, 1, 0});
  // Without an up the frame of the last segment goes along by the shortest rotation, which leaves the axis alone.
  const Organ transported = frame("F@R(1,0,0)");
  check_close(transported.up, {0, 0, 1});
  check_close(frame("F@R(1,0,0,5,0,0)").up, {0, 0, 1});
}

TEST_CASE("organs have kind, size, place, colour and the segment they sit on") {
  const Skeleton skeleton = drawn("!(4)F;(7)@O@o(2)[F+(90)~l(0.5)]@c~k(1,2,3)");
  REQUIRE(skeleton.organs.size() == 5);
  const std::vector<std::string> kinds{"@O", "@o", "~l", "@c", "~k"};
  const std::vector<double> sizes{4, 2, 0.5, 4, 1};
  const std::vector<int> internodes{0, 0, 1, 0, 0};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    CHECK(skeleton.organs[i].kind == kinds[i]);
    CHECK(skeleton.organs[i].size == sizes[i]);
    CHECK(skeleton.organs[i].internode == internodes[i]);
    CHECK(skeleton.organs[i].color == 7);
  }
  check_close(skeleton.organs[2].position, {0, 2, 0});
  check_close(skeleton.organs[2].heading, {-1, 0, 0});
  CHECK(drawn("@O").organs[0].internode == kNoInternode);
}

TEST_CASE("colours count modulo 256") {
  const auto color = [](const std::string& text) { return drawn(text + "@O").organs[0].color; };
  CHECK(color("") == 128);
  CHECK(color(";;,") == 129);
  CHECK(color(";(255);") == 0);
  CHECK(color(",(0),") == 255);
  CHECK(color("@;") == 128);  // of the back side
}

TEST_CASE("commands of several letters that are unknown leave their letters") {
  CHECK(drawn("@F").internodes.size() == 1);
  CHECK(drawn("@DF").internodes.size() == 1);
  CHECK(drawn("@Gc(3)F").internodes.size() == 1);
  CHECK(drawn("@").internodes.empty());
  CHECK(drawn("@L(0)@S(0)@Tx(1)@#(2)@!(6)@mo?P(0,0)F").internodes.size() == 1);
  CHECK(drawn("[F@mc(1)F[F]]F@mc(0)F").internodes.size() == 3);
}

TEST_CASE("a sub-L-system's scale holds between its marks") {
  const Skeleton skeleton = drawn("!(1)F(1)?(2,3)F(1)$F(1)");
  CHECK(skeleton.internodes[1].tip.y == 4);
  CHECK(skeleton.internodes[1].base_radius == 1.5);
  CHECK(skeleton.internodes[2].tip.y == 5);
  CHECK(skeleton.internodes[2].base_radius == 0.5);
}

TEST_CASE("a homomorphism is drawn, except under the letter of a command") {
  const Grammar grammar = parse_grammar(
      lsystem_text("A(2)[B]@O(5)l",
                   "\nhomomorphism\nA(x) --> !(x)F(x)\nB --> +(90)F(1)@O(1)\nO(x) --> F(9)\nl --> @c(7)\n"),
      "test.l");
  const Skeleton skeleton = interpret(derive(grammar), &grammar);
  REQUIRE(skeleton.internodes.size() == 2);
  check_close(skeleton.internodes[0].tip, {0, 2, 0});
  check_close(skeleton.internodes[1].tip, {-1, 2, 0});
  REQUIRE(skeleton.organs.size() == 3);
  CHECK(skeleton.organs[1].kind == "@O");
  CHECK(skeleton.organs[1].size == 5);
  CHECK(skeleton.organs[2].size == 7);
}

TEST_CASE("segments remember the step that made their module") {
  const Grammar grammar = parse_grammar(
      "Lsystem: 1\nderivation length: 3\naxiom: A\nA --> IA\nhomomorphism\nI --> F\nendlsystem\n", "test.l");
  const Skeleton skeleton = interpret(derive(grammar), &grammar);
  REQUIRE(skeleton.internodes.size() == 3);
  for (int i = 0; i < 3; ++i) CHECK(skeleton.internodes[static_cast<std::size_t>(i)].birth_step == i + 1);
}

TEST_CASE("an empty word and a word without segments are empty skeletons") {
  CHECK(drawn("").internodes.empty());
  CHECK(drawn("A[B]ff").internodes.empty());
}

TEST_CASE("what has no effect yet is told once") {
  std::vector<std::string> notes;
  TurtleOptions options;
  options.notify = [&](const std::string& message) { notes.push_back(message); };
  drawn("{.f.}{.f.}@GsF@Ge_(0.1)", options);
  CHECK(notes.size() == 3);
}

TEST_CASE("@W sets the ridge of the segments that follow, on branches too, and without numbers takes it back") {
  const Skeleton skeleton = drawn("F@W(0.25,0.0625)[F]F[@W(0.5)F]F@WF");
  REQUIRE(skeleton.internodes.size() == 6);
  std::vector<std::int32_t> ridges;
  for (const Internode& internode : skeleton.internodes) ridges.push_back(internode.ridge);
  CHECK(ridges == std::vector<std::int32_t>{kNoRidge, 0, 0, 1, 0, kNoRidge});
  CHECK(skeleton.ridges == std::vector<Ridge>{{0.25, 0.0625}, {0.5, 0.125}});
}

TEST_CASE("a ridge's swelling at a limit is not refused for its rounding, and one outside is") {
  for (const char* text : {"@W(0.48,0.16)F", "@W(0.3,0.1)F", "@W(0.3,0.05)F", "@W(0.07,0.0116666667)F"}) {
    const Ridge ridge = drawn(text).ridges.at(0);
    CHECK((ridge.swelling == ridge.width / 3 || ridge.swelling == ridge.width / 6));
  }
  for (const char* text : {"@W(0.6)F", "@W(0)F", "@W(0.3,0.04)F", "@W(0.3,0.6)F"}) {
    CHECK_THROWS_AS(drawn(text), InputError);
  }
}
