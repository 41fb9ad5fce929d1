#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "lsystem/word.h"

using namespace barkridge;

namespace {

std::string reread(const std::string& text) { return to_string(parse_word(text, "test.str")); }

}  // namespace

TEST_CASE("a word prints its parameters as C's %g does") {
  CHECK(reread("F(1)[+(60)F(0.5)]A(1e-7,123456789,-0.25)") == "F(1)[+(60)F(0.5)]A(1e-07,1.23457e+08,-0.25)");
}

TEST_CASE("a line is broken before a module once it has 70 characters") {
  const std::string text = reread(std::string(150, 'F'));
  CHECK(text == std::string(70, 'F') + "\n" + std::string(70, 'F') + "\n" + std::string(10, 'F'));
  CHECK(reread(std::string(69, 'F') + "A(1)B") == std::string(69, 'F') + "A(1)\nB");
}

TEST_CASE("commas do not count towards the length of a line") {
  CHECK(reread(std::string(64, 'F') + "A(1,2)BC") == std::string(64, 'F') + "A(1,2)B\nC");
}

TEST_CASE("white space is passed over, except inside numbers") {
  CHECK(reread(" F ( 1 ,\n 2 )\tA\r\n+( +3 )") == "F(1,2)A+(3)");
}

TEST_CASE("what was printed reads and prints the same") {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    Word word;
    int open = 0;
    for (int i = 0; i < 100; ++i) {
      char symbol = static_cast<char>('!' + random() % 94);
      if (symbol == '(' || symbol == ')') symbol = 'A';
      if (symbol == '[') ++open;
      if (symbol == ']' && --open < 0) {
        symbol = 'B';
        open = 0;
      }
      const auto count = static_cast<std::uint8_t>(random() % 4);
      word.modules.push_back({symbol, count, 0, static_cast<std::uint32_t>(word.parameters.size())});
      for (int k = 0; k < count; ++k) {
        const double mantissa = static_cast<double>(random()) / 4294967296.0 - 0.5;
        word.parameters.push_back(static_cast<float>(std::ldexp(mantissa, static_cast<int>(random() % 60) - 30)));
      }
    }
    for (; open > 0; --open) word.modules.push_back({']', 0, 0, 0});
    const std::string text = to_string(word);
    CHECK(reread(text) == text);
  }
}

TEST_CASE("an empty text is an empty word") {
  CHECK(parse_word("", "test.str").modules.empty());
  CHECK(parse_word(" \n", "test.str").modules.empty());
}

TEST_CASE("numbers too small for a float become 0") { CHECK(reread("A(1e-300,1e-999)") == "A(0,0)"); }
