#include <catch2/catch.hpp>

#include "base/error.h"
#include "lsystem/turtle.h"
#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

TEST_CASE("a word stops growing at the limit of modules, and the message says when and how to go on") {
  const Grammar grammar =
      parse_grammar("Lsystem: 1\nderivation length: 99\naxiom: A\nA --> AA\nendlsystem\n", "test.l");
  DeriveOptions options;
  options.max_modules = 1000;
  CHECK_THROWS_AS(derive(grammar, options), LimitError);
  CHECK_THROWS_WITH(derive(grammar, options),
                    "step 10: the word would have more than 1000 modules; --max-modules raises this limit");
  options.steps = 9;
  CHECK(derive(grammar, options).modules.size() == 512);
  options.max_modules = 512;
  CHECK(derive(grammar, options).modules.size() == 512);
}

TEST_CASE("a word stops growing at the limit of memory") {
  const Grammar grammar = parse_grammar(
      "Lsystem: 1\nderivation length: 99\naxiom: A(1,2)\nA(x,y) --> A(x,y)A(y,x)\nendlsystem\n", "test.l");
  DeriveOptions options;
  options.max_memory = 1 << 20;
  CHECK_THROWS_AS(derive(grammar, options), LimitError);
  CHECK_THROWS_WITH(derive(grammar, options), Catch::Contains("--max-memory"));
  options.steps = 14;  // 2^14 modules of 16 bytes, and half as many before them
  CHECK(derive(grammar, options).modules.size() == 16384);
}

TEST_CASE("decompositions and homomorphisms that go on for ever are stopped") {
  CHECK_THROWS_AS(rewritten("A", "\ndecomposition\nmaximum depth: 1000000000\nA --> A\n"), LimitError);
  std::vector<std::string> notes;
  CHECK_THROWS_AS(interpreted("A", "maximum depth: 1000000000\nA --> A\n", &notes), LimitError);
  CHECK_THROWS_AS(interpreted("A", "maximum depth: 60\nA --> AA\n", &notes), LimitError);
}

TEST_CASE("expressions and statements may not be nested without bound") {
  const std::string open(100000, '(');
  CHECK_THROWS_WITH(value_of(open + "1"), Catch::Contains("nested more than"));
  CHECK_THROWS_WITH(value_of(std::string(100000, '-') + "1"), Catch::Contains("nested more than"));
  std::string blocks;
  for (int i = 0; i < 1000; ++i) blocks += "if (1) {";
  CHECK_THROWS_WITH(value_of("1", "start: {" + blocks), Catch::Contains("nested more than"));
  std::string sum = "1";
  for (int i = 0; i < 1000; ++i) sum += "+1";
  CHECK(value_of(sum) == "1001");
}

TEST_CASE("a loop that never ends is stopped") {
  CHECK_THROWS_AS(value_of("1", "start: { while (1) { x = 1; } }\n"), LimitError);
  CHECK(value_of("x", "start: { while (x < 100000) { x = x + 1; } }\n") == "100000");
}

TEST_CASE("a skeleton stops growing at its limits") {
  const Word word = parse_word("FFF[[F]]", "test.str");
  TurtleOptions options;
  options.max_internodes = 3;
  CHECK_THROWS_AS(interpret(word, nullptr, options), LimitError);
  options.max_internodes = 4;
  CHECK(interpret(word, nullptr, options).internodes.size() == 4);
  options.max_bracket_depth = 1;
  CHECK_THROWS_AS(interpret(word, nullptr, options), LimitError);
}

TEST_CASE("a million nested brackets are drawn") {
  constexpr std::size_t kDepth = 1'000'000;
  std::string text;
  for (std::size_t i = 0; i < kDepth; ++i) text += "F[";
  text.append(kDepth, ']');
  const Skeleton skeleton = interpret(parse_word(text, "test.str"));
  REQUIRE(skeleton.internodes.size() == kDepth);
  CHECK(skeleton.internodes.back().order == kDepth - 1);
  CHECK(skeleton.internodes.back().tip.y == kDepth);
}

TEST_CASE("a derivation and a drawing can be cancelled") {
  const Grammar grammar = parse_grammar(lsystem_text("A", "A --> F\n"), "test.l");
  DeriveOptions options;
  options.progress = [](double) { return false; };
  CHECK_THROWS_AS(derive(grammar, options), Cancelled);
  TurtleOptions drawing;
  drawing.progress = [](double) { return false; };
  CHECK_THROWS_AS(interpret(parse_word("F", "test.str"), nullptr, drawing), Cancelled);
}

TEST_CASE("progress never goes back and ends at 1") {
  const Grammar grammar =
      parse_grammar("Lsystem: 1\nderivation length: 17\naxiom: A\nA --> AA\nendlsystem\n", "test.l");
  double last = 0;
  bool rising = true;
  DeriveOptions options;
  options.progress = [&](double fraction) {
    rising = rising && fraction >= last;
    last = fraction;
    return true;
  };
  derive(grammar, options);
  CHECK(rising);
  CHECK(last == 1);
}
