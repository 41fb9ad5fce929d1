#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "lsystem/preprocessor.h"
#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

namespace {

/// The preprocessed text without blanks, which the language does not care about.
std::string preprocessed(const std::string& text, const std::map<std::string, std::string>& defines = {}) {
  const SourceText source = preprocess(text, "test.l", defines);
  std::string result;
  for (const char c : source.text()) {
    if (c != ' ') result += c;
  }
  return result;
}

}  // namespace

TEST_CASE("comments of both kinds vanish") {
  CHECK(preprocessed("A/* x */B // C\nD/**/E\n") == "AB\nDE\n");
  CHECK(preprocessed("\"/* no */ // comment\"\n") == "\"/*no*///comment\"\n");
}

TEST_CASE("a backslash joins lines and carriage returns do not matter") {
  CHECK(preprocessed("A\\\nB\r\nC\\\r\nD\n") == "AB\nCD\n");
}

TEST_CASE("names are replaced as whole words only") {
  CHECK(preprocessed("#define LEN 3\nF(LEN)LENGTH(1)2LEN\n") == "F(3)LENGTH(1)2LEN\n");
  CHECK(preprocessed("#define LEN 3\n#undef LEN\nLEN\n") == "LEN\n");
}

TEST_CASE("macros with arguments expand to modules") {
  CHECK(preprocessed("#define LEAF(s,c) [;(c)~l(s*2)]\nA --> LEAF(x+(1,2),3)F\n") == "A-->[;(3)~l(x+(1,2)*2)]F\n");
  CHECK(preprocessed("#define TWICE(x) x x\nTWICE(TWICE(A))LEFT TWICE\n") == "AAAALEFTTWICE\n");
  CHECK(preprocessed("#define NONE() X\nNONE()\n") == "X\n");
}

TEST_CASE("a macro may stand for another, and its arguments on several lines") {
  CHECK(preprocessed("#define S SEG\n#define SEG(a,b) F(a)G(b)\nS(1,\n\t2)\n") == "F(1)G(2)\n");
}

TEST_CASE("a macro that names itself is left alone") {
  CHECK(preprocessed("#define A B A\n#define B A B\nA\n") == "ABA\n");
}

TEST_CASE("a hash that begins no directive is a module") {
  CHECK(preprocessed("#(2) --> F\n# --> G\n") == "#(2)-->F\n#-->G\n");
}

TEST_CASE("conditionals choose lines") {
  const std::string text =
      "#define N 3\n#if N > 2 && !defined(X)\nbig\n#elif N\nsome\n#else\nnone\n#endif\n#ifdef X\nx\n#else\nno "
      "x\n#endif\n";
  CHECK(preprocessed(text) == "big\nnox\n");
  CHECK(preprocessed(text, {{"N", "1"}}) == "some\nnox\n");
  CHECK(preprocessed(text, {{"N", "0"}}) == "none\nnox\n");
  CHECK(preprocessed("#if 0\n#if 1\nA\n#else\nB\n#endif\n#else\nC\n#endif\n") == "C\n");
  CHECK(preprocessed("#ifndef X\n#define X 7\n#endif\nX\n") == "7\n");
}

TEST_CASE("conditions have C's integers and operators") {
  const auto holds = [](const std::string& condition) {
    return preprocessed("#if " + condition + "\nyes\n#endif\n") == "yes\n";
  };
  CHECK(holds("1 + 2 * 3 == 7"));
  CHECK(holds("7 / 2 == 3 && 7 % 2 == 1"));
  CHECK(holds("(1 ? 2 : 3) == 2"));
  CHECK(holds("-(2 - 5) >= 3"));
  CHECK(holds("!unknown"));
  CHECK_FALSE(holds("0 || !1"));
  CHECK_FALSE(holds("2 < 1"));
}

TEST_CASE("values from outside replace those of the text") {
  const std::string text = "#define LEN 3\nLsystem: 1\naxiom: F(LEN)\n\nendlsystem\n";
  CHECK(to_string(derive(parse_grammar(text, "test.l", {{"LEN", "2*5"}}))) == "F(10)");
  CHECK(preprocessed("#ifndef N\n#define N 3\n#endif\nN\n", {{"N", "4"}}) == "4\n");
}

TEST_CASE("a value for a name that the text does not define is refused") {
  CHECK_THROWS_WITH(preprocessed("#define LEN 3\nF\n", {{"WIDTH", "4"}}),
                    "test.l: `WIDTH` cannot be set: the file has no `#define WIDTH`; it defines LEN");
}

TEST_CASE("files are included relative to the including file, and mistakes are shown in them") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "barkridge_include_test";
  std::filesystem::create_directories(folder / "parts");
  std::ofstream(folder / "parts" / "a.h") << "#include \"b.h\"\nA --> A(ANGLE)\n";
  std::ofstream(folder / "parts" / "b.h") << "#define ANGLE 30\n";
  std::ofstream(folder / "parts" / "bad.h") << "A --> B\nB --> (\n";
  std::ofstream(folder / "parts" / "loop.h") << "#include \"loop.h\"\n";
  const std::string file = (folder / "main.l").string();
  const auto text = [](const std::string& part) {
    return "Lsystem: 1\nderivation length: 1\naxiom: A\n#include \"parts/" + part + "\"\nendlsystem\n";
  };
  CHECK(to_string(derive(parse_grammar(text("a.h"), file))) == "A(30)");
  try {
    parse_grammar(text("bad.h"), file);
    FAIL("a bad include was read");
  } catch (const InputError& error) {
    CHECK(error.where().file == (folder / "parts" / "bad.h").string());
    CHECK(error.where().line == 2);
    CHECK(error.where().column == 7);
  }
  CHECK_THROWS_WITH(parse_grammar(text("loop.h"), file), Catch::Contains("include itself?"));
  CHECK_THROWS_WITH(parse_grammar(text("absent.h"), file),
                    Catch::Contains("main.l:4:10: ") && Catch::Contains("absent.h"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("line markers rename the place of mistakes") {
  try {
    parse_grammar("# 12 \"original.l\"\nLsystem: 1\naxiom: (\n", "test.l");
    FAIL("a bad axiom was read");
  } catch (const InputError& error) {
    CHECK(error.where().file == "original.l");
    CHECK(error.where().line == 13);
  }
}

TEST_CASE("a mistake that comes from a macro is shown where the macro is used") {
  try {
    parse_grammar("#define BAD F(\\\n\t)\nLsystem: 1\naxiom: A\nA --> B BAD\nendlsystem\n", "test.l");
    FAIL("a bad macro was read");
  } catch (const InputError& error) {
    CHECK(error.where().line == 5);
    CHECK(error.where().column == 9);
    CHECK(error.where().line_text == "A --> B BAD");
  }
}

TEST_CASE("macros that grow without bound are stopped") {
  std::string text = "#define A FFFFFFFFFF\n";
  for (char name = 'B'; name < 'M'; ++name) {
    text += std::string("#define ") + name;
    for (int i = 0; i < 10; ++i) text += std::string(" ") + static_cast<char>(name - 1);
    text += '\n';
  }
  CHECK_THROWS_AS(preprocess(text + "L\n", "test.l"), LimitError);
  std::string nested = "A";
  for (int i = 0; i < 1000; ++i) nested = std::string("F(").append(nested).append(")");
  CHECK_THROWS_WITH(preprocess("#define F(x) x\n" + nested + "\n", "test.l"), Catch::Contains("nested more than"));
}
