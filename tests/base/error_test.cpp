#include "base/error.h"

#include <catch2/catch.hpp>

using namespace barkridge;

TEST_CASE("a place counts lines and columns from one and carries its line") {
  const std::string text = "first\nsecond line\nthird";
  const SourceLocation where = locate(text, 13, "a.l");
  CHECK(where.file == "a.l");
  CHECK(where.line == 2);
  CHECK(where.column == 8);
  CHECK(where.line_text == "second line");
  CHECK(locate(text, 0, "").line == 1);
  CHECK(locate(text, 5, "").line == 1);
  CHECK(locate(text, 1000, "").line == 3);
  CHECK(locate("a\r\nb", 0, "").line_text == "a");
}

TEST_CASE("an input error shows file, line, column, the line and a caret") {
  const InputError error(locate("x = 1\n\ty == 2", 9, "scene.toml"), "expected a value");
  CHECK(std::string(error.what()) == "scene.toml:2:4: expected a value\n  \ty == 2\n  \t  ^");
  CHECK(error.message() == "expected a value");
}

TEST_CASE("the caret counts characters, not bytes of UTF-8") {
  const std::string text = "\xC3\xA4\xC3\xB6 ?";
  CHECK(std::string(InputError(locate(text, 5, "f"), "no").what()) == "f:1:6: no\n  " + text + "\n     ^");
}
