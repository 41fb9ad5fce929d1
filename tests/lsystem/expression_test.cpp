#include <catch2/catch.hpp>

#include "base/error.h"
#include "lsystem/machine.h"
#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

TEST_CASE("operators have cpfg's precedences") {
  CHECK(value_of("2^3^2") == "64");
  CHECK(value_of("-2^2") == "4");
  CHECK(value_of("!1+1") == "1");
  CHECK(value_of("2+3*4") == "14");
  CHECK(value_of("10-4-3") == "3");
  CHECK(value_of("2*3%4") == "2");
  CHECK(value_of("1||0&&0") == "1");
  CHECK(value_of("1?2:0?3:4") == "2");
  CHECK(value_of("0?2:0?3:4") == "4");
  CHECK(value_of("1+1==2") == "1");
  CHECK(value_of("1<2==2>1") == "1");
  CHECK(value_of("2<>2") == "0");
  CHECK(value_of("2!=3") == "1");
  CHECK(value_of("2^-1") == "0.5");
}

TEST_CASE("numbers are integers and reals, with exponents after either") {
  CHECK(value_of(".5+2.") == "2.5");
  CHECK(value_of("1.5e-3") == "0.0015");
  CHECK(value_of("1e-7") == "1e-07");
  CHECK(value_of("1E3") == "1000");
}

TEST_CASE("functions work in degrees, and trunc rounds") {
  CHECK(value_of("sin(30)") == "0.5");
  CHECK(value_of("cos(60)") == "0.5");
  CHECK(value_of("tan(45)") == "1");
  CHECK(value_of("asin(1)") == "90");
  CHECK(value_of("acos(0)") == "90");
  CHECK(value_of("atan(1)") == "45");
  CHECK(value_of("exp(log(5))") == "5");
  CHECK(value_of("floor(-1.5)") == "-2");
  CHECK(value_of("ceil(-1.5)") == "-1");
  CHECK(value_of("sqrt(2)") == "1.41421");
  CHECK(value_of("fabs(-3)") == "3");
  CHECK(value_of("sign(-3)+10*sign(0)+100*sign(2)") == "99");
  CHECK(value_of("trunc(1.5)") == "2");
  CHECK(value_of("trunc(1.4)") == "1");
  CHECK(value_of("trunc(-1.5)") == "-1");
}

TEST_CASE("a division by 0 yields the dividend, and a remainder truncates both operands") {
  CHECK(value_of("5/0") == "5");
  CHECK(value_of("7.9%4.9") == "3");
  CHECK(value_of("-7%4") == "-3");
  CHECK(value_of("7%0") == "0");
}

TEST_CASE("and, or and choices leave out what does not matter") {
  // Each unwanted evaluation would take a random number.
  const std::string first = value_of("ran(1)", "start: { srand(5); }\n");
  CHECK(first == "0.52484");
  CHECK(value_of("ran(1)", "start: { srand(5); x = 0 && ran(1); }\n") == first);
  CHECK(value_of("ran(1)", "start: { srand(5); x = 1 || ran(1); }\n") == first);
  CHECK(value_of("ran(1)", "start: { srand(5); x = 1 ? 2 : ran(1); }\n") == first);
  CHECK(value_of("ran(1)", "start: { srand(5); x = 0 ? ran(1) : 2; }\n") == first);
  CHECK(value_of("ran(1)", "start: { srand(5); x = 1 && ran(1); }\n") == "0.272854");
  CHECK(value_of("(3 && 2) + 10 * (0 || 5)") == "11");
}

TEST_CASE("parameters are single precision, computed in double") {
  CHECK(value_of("(1/3)*3 == 1") == "1");
  // 2^24 + 1 is no float.
  CHECK(rewritten("A(16777217)", "A(x) : x == 16777216 --> B\n") == "B");
}

TEST_CASE("statements compute with branches and loops") {
  const std::string factorial = "start: { n = 5; f = 1;\nwhile (n > 1) { f = f * n; n = n - 1; } }\n";
  CHECK(value_of("f", factorial) == "120");
  CHECK(value_of("k", "start: { k = 0; do { k = k + 1; } while (k < 3); }\n") == "3");
  CHECK(value_of("k", "start: { do { k = 7; } while (0); }\n") == "7");
  const std::string branch = "start: { x = 2; if (x == 1) { y = 10; } else { if (x == 2) { y = 20; } } }\n";
  CHECK(value_of("y", branch) == "20");
}

TEST_CASE("arrays are initialised row by row and clamp their indices") {
  const std::string array = "define: { array p[3][2] = {1,2,3,4,5,6}, q[2]; }\n";
  CHECK(value_of("p[0][1]*100 + p[1][0]*10 + p[2][1]", array) == "236");
  CHECK(value_of("q[0]+q[1]", array) == "0");
  CHECK(value_of("p[7][0-3]", array) == "5");
  CHECK(value_of("q[1]", array + "start: { q[0+1] = 4; q[1] = q[1] + p[0][0]; }\n") == "5");
}

TEST_CASE("a value is computed before the indices it goes to") {
  const std::string items = "define: { array a[2]; }\nstart: { srand(5); a[floor(ran(2))] = ran(1); }\n";
  // The stream begins 0.52484 0.272854: the first is the value, the second makes index 0.
  CHECK(value_of("a[0]", items) == "0.52484");
  CHECK(value_of("a[1]", items) == "0");
}

TEST_CASE("Q is the step, Z the derivation length, and names in blocks are global") {
  CHECK(grown("Lsystem: 1\nderivation length: 3\naxiom: A(Q,Z)\nA(x,y) --> A(Q,Z)\nendlsystem\n", 2) == "A(2,3)");
  CHECK(grown("Lsystem: 1\nderivation length: 3\nstart each: {k = k + Q;}\naxiom: A\nA --> A(k)\nA(x) --> A(k)\n"
              "endlsystem\n") == "A(6)");
}

TEST_CASE("a production's own variables keep their values") {
  CHECK(rewritten("AAA", "A : { n = n + 1; } 1 --> B(n)\n") == "B(1)B(2)B(3)");
  CHECK(rewritten("AC", "A : { n = 5; } 1 --> B(n)\nC --> B(n)\n") == "B(5)B(0)");
}

TEST_CASE("the derivation length can be changed as it goes, and stop ends it") {
  const std::string text =
      "Lsystem: 1\nderivation length: 2\nstart: { x = SetDerivationLength(4); }\n"
      "axiom: A(GetDerivationLength(0))\nA(x) --> A(x+1)\nendlsystem\n";
  CHECK(grown(text) == "A(8)");
  const std::string stopping =
      "Lsystem: 1\nderivation length: 9\nend each: { if (Q == 4) { stop(2); } }\n"
      "axiom: A(0)\nA(x) --> A(x+1)\nendlsystem\n";
  CHECK(grown(stopping) == "A(4)");
  const std::string showing =
      "Lsystem: 1\nderivation length: 9\nend each: { if (Q == 4) { stop(1); } }\n"
      "axiom: A(0)\nA(x) --> A(x+1)\nendlsystem\n";
  CHECK(grown(showing) == "A(9)");
}

TEST_CASE("strings count from 0 and printf tells the listener") {
  CHECK(grown(lsystem_text("@L(\"a\",18.6)@L(\"b\")", "")) == "@L(0,18.6)@L(1)");
  std::vector<std::string> notes;
  const Grammar grammar =
      parse_grammar(lsystem_text("A", "", "start: { printf(\"%d %.2f %5g%%\\n\", 3, 0.125, 7); }\n"), "test.l");
  DeriveOptions options;
  options.notify = [&](const std::string& message) { notes.push_back(message); };
  derive(grammar, options);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "3 0.12     7%\n");
}

TEST_CASE("printf takes numbers only, one a conversion") {
  CHECK(format_printf("%s%n %q %", {1, 2}) == "%s%n %q %");
  CHECK(format_printf("%g %g", {1}) == "1 0");
  CHECK(format_printf("%-4d|", {2.9}) == "2   |");
}

TEST_CASE("what is odd but not wrong is told once, with its place") {
  std::vector<std::string> notes;
  const Notify listener = [&](const std::string& message) { notes.push_back(message); };
  const Grammar grammar = parse_grammar(lsystem_text("AAA", "A --> A(1/0)F(unknown)\n"), "test.l", {}, listener);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "test.l:4:15: `unknown` is not defined; it starts as 0");
  DeriveOptions options;
  options.notify = listener;
  CHECK(to_string(derive(grammar, options)) == "A(1)F(0)A(1)F(0)A(1)F(0)");
  REQUIRE(notes.size() == 2);
  CHECK(notes[1] == "test.l:4:10: division by 0; the dividend is used as the quotient");
}
