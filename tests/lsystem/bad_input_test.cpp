#include <catch2/catch.hpp>

#include <string>

#include "base/error.h"
#include "lsystem/turtle.h"
#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

namespace {

/// "line:column: message" of the error that the text's parsing or one step of its derivation ends with.
std::string mistake(const std::string& text) {
  try {
    derive(parse_grammar(text, "test.l"));
  } catch (const InputError& error) {
    return std::to_string(error.where().line) + ":" + std::to_string(error.where().column) + ": " + error.message();
  }
  return "none";
}

/// The same for a production of `A(x)`, in line 4.
std::string mistake_in(const std::string& production) { return mistake(lsystem_text("A(1)", production + "\n")); }

std::string mistake_in_word(const std::string& text) {
  try {
    interpret(parse_word(text, "test.str"));
  } catch (const InputError& error) {
    return error.message();
  }
  return "none";
}

}  // namespace

TEST_CASE("a message shows file, line, column, the line and a caret") {
  CHECK_THROWS_WITH(parse_grammar(lsystem_text("A", "A --> F(1\n"), "tree.l"),
                    "tree.l:4:10: expected `)` after a module's parameters, not the end of the line\n"
                    "  A --> F(1\n"
                    "           ^");
}

TEST_CASE("the parts of an L-system are wanted in their order") {
  CHECK(mistake("") ==
        "1:1: expected `Lsystem: label`, not the end of the file; only cpfg's language is supported yet");
  CHECK(mistake("LSYSTEM: 1\n").starts_with("1:1: expected `Lsystem: label`, not `LSYSTEM`"));
  CHECK(mistake("Lsystem:\naxiom: A\n") == "1:9: expected a label after `Lsystem:`, such as 1");
  CHECK(mistake("Lsystem: 1\naxiom:\n") == "2:7: expected the axiom's modules");
  CHECK(mistake("Lsystem: 1\nB --> C\n").starts_with("2:1: expected `axiom:`"));
  CHECK(mistake("Lsystem: 1\naxiom: A\nendlsystem\n") == "3:1: expected a production after the axiom");
  CHECK(mistake("Lsystem: 1\naxiom: A\nA --> B\n") == "3:8: expected `endlsystem`, not the end of the file");
  CHECK(mistake("Lsystem: 1\naxiom: A\nignore: B\nA --> B\nendlsystem\n") ==
        "3:1: this item must stand before the axiom");
  CHECK(mistake(lsystem_text("A", "A-->B\nhomomorphism\nA-->C\ndecomposition\nA-->D\n")) ==
        "7:1: the decomposition must stand once, before the homomorphism");
  CHECK(mistake(lsystem_text("A", "A-->B\n") + "C") == "7:1: unexpected `C` after `endlsystem`");
}

TEST_CASE("mistakes in productions are found where they are") {
  CHECK(mistake_in("A(x) F") ==
        "4:7: expected `-->`, not the end of the line; a statement goes on in the next line only "
        "if that begins with a tab");
  CHECK(mistake_in("A(x) --> B\n  C").starts_with("5:4: expected `-->`"));
  CHECK(mistake_in("A(x) -> B") == "4:6: the arrow of a production is `-->`");
  CHECK(mistake_in("--> B") == "4:1: expected a predecessor, not `-`");
  CHECK(mistake_in("A(x) -->") == "4:9: expected a successor, or `*` for none, not the end of the line");
  CHECK(mistake_in("A(1) --> B") == "4:3: expected a parameter's name, not `1`");
  CHECK(mistake_in("A(x,x) --> B") == "4:5: `x` is already defined here");
  CHECK(mistake_in("A(x) --> B(") == "4:12: expected a number, a name or `(`, not the end of the line");
  CHECK(mistake_in("A(x) --> B()") == "4:12: expected a number, a name or `(`, not `)`");
  CHECK(mistake_in("A(x) --> B)") == "4:11: expected a module, not `)`");
  CHECK(mistake_in("A(x) --> (B)") == "4:10: expected a module, not `(`");
  CHECK(mistake_in("A(x) --> B\xC3\xA4") == "4:11: modules are single visible ASCII characters");
  CHECK(mistake_in("A(x) : --> B") == "4:8: expected a number, a name or `(`, not `-`");
  CHECK(mistake_in("A(x) : x=1 --> B") == "4:9: `=` assigns and stands in statements only; `==` compares");
  CHECK(mistake_in("A(x) : {y=1} 1 --> B") == "4:12: expected `;` after a statement, not `}`");
  CHECK(mistake_in("A(x) : {y=1; 1 --> B").starts_with("4:16: "));
  CHECK(mistake_in("A(x) --> B : 1 2") == "4:16: unexpected `2` after a production");
}

TEST_CASE("mistakes in expressions are found where they are") {
  CHECK(mistake_in("A(x) --> B(x y)") == "4:14: expected `)` after a module's parameters, not `y`");
  CHECK(mistake_in("A(x) --> B(foo(1))") == "4:12: `foo` is not a function");
  CHECK(mistake_in("A(x) --> B(sin)") == "4:15: expected `(` after a function's name, not `)`");
  CHECK(mistake_in("A(x) --> B(sin(1,2))") == "4:12: `sin` takes 1 argument, but 2 are given");
  CHECK(mistake_in("A(x) --> B(nran(1))") == "4:12: `nran` takes 2 arguments, but 1 are given");
  CHECK(mistake_in("A(x) --> B(p[1])") == "4:12: `p` is not an array");
  CHECK(mistake_in("A(x) --> B(x ? 1)") == "4:17: expected `:` in a choice `a ? b : c`, not `)`");
  CHECK(mistake_in("A(x) --> B((x)") == "4:15: expected `)` after a module's parameters, not the end of the line");
  CHECK(mistake_in("A(x) --> B(\"text)") == "4:12: this string lacks its closing quote");
  CHECK(mistake_in("A(x) --> B(1e999)") == "4:12: this number is out of range");
  CHECK(mistake_in("A(x) --> B(atan2(1,2))") == "4:12: `atan2` is no function of cpfg's grammar; use `atan`");
  CHECK(mistake_in("A(x) --> B(if)") == "4:12: `if` cannot stand in an expression");
}

TEST_CASE("mistakes in items are found where they are") {
  const auto item = [](const std::string& text) {
    return mistake("Lsystem: 1\n" + text + "\naxiom: A\nA --> B\nendlsystem\n");
  };
  CHECK(item("derivation length:") == "2:19: expected a number, a name or `(`, not the end of the line");
  CHECK(item("derivation length: 1 2") == "2:22: unexpected `2` after this item");
  CHECK(item("derivation length: 1e300") == "2:20: the derivation length is out of range");
  CHECK(item("derivation length : 1").starts_with("2:1: expected `axiom:`"));
  CHECK(item("define: { array p[3,2]; }") ==
        "2:20: expected `]` after an array's size; each index has brackets of its own, "
        "not `,`");
  CHECK(item("define: { array p[0]; }") == "2:19: an array's size must be at least 1");
  CHECK(item("define: { array p[2] = {1,2,3}; }") == "2:29: `p` has only 2 elements");
  CHECK(item("define: { array p[2]; }\nstart: { p = 1; }") == "3:10: `p` is an array and needs an index");
  CHECK(item("define: { array p[2]; }\nstart: { p[1][1] = 1; }") == "3:10: array `p` has 1 indices, but 2 are given");
  CHECK(item("define: { array p[1000000][1000000]; }") == "2:28: an array may have at most 1048576 elements");
  CHECK(mistake("Lsystem: 1\nstart: { x = 1;\n").starts_with("2:8: these statements lack their `}`"));
}

TEST_CASE("mistakes in directives are found where they are") {
  CHECK(mistake("#if 1\n") == "1:2: this conditional lacks its `#endif`");
  CHECK(mistake("#endif\n") == "1:2: #endif without #if");
  CHECK(mistake("#if 1\n#else\n#else\n") == "3:2: #else after #else");
  CHECK(mistake("#if 1.5\n#endif\n").starts_with("1:5: `1.5` is not an integer"));
  CHECK(mistake("#if 1/0\n#endif\n").starts_with("1:5: division by zero"));
  CHECK(mistake("#define\n").starts_with("1:8: expected a name"));
  CHECK(mistake("#define F(a,) 1\n").starts_with("1:9: "));
  CHECK(mistake("#define F(a,b) a\nF(1)\n") == "2:1: macro `F` takes 2 arguments, but 1 are given");
  CHECK(mistake("#define F(a) a\nF(1\n") == "2:1: the arguments of macro `F` lack their `)`");
  CHECK(mistake("#error no way\n") == "1:2: #error no way");
  CHECK(mistake("A /* B\n") == "1:3: this comment lacks its `*/`");
}

TEST_CASE("what is not supported yet is refused by name") {
  CHECK(mistake("#include <lpfgall.h>\n").find("L+C") != std::string::npos);
  CHECK(mistake("Lsystem: 1\nring Lsystem\n") == "2:1: ring L-systems are not supported yet");
  CHECK(mistake_in("A(x) --> ?P(0,0)") == "4:10: queries and communication (`?`) are not supported yet");
  CHECK(mistake_in("A(x) --> ?(2,1)B$") == "4:10: sub-L-systems (`?(...)`) are not supported yet");
  CHECK(mistake_in("A(x) --> B$") ==
        "4:11: sub-L-systems (`$`) are not supported yet; to roll to the horizontal write `@v`");
  CHECK(mistake_in("A(x) --> B%(1)") == "4:11: `%` with parameters is not supported yet");
  CHECK(mistake_in("A(x) --> B(func(1,x))") == "4:12: the function `func` is not supported yet");
  CHECK(mistake(lsystem_text("A", "A --> B\n") + "Lsystem: 2\naxiom: B\n") ==
        "7:1: sub-L-systems are not supported yet");
  CHECK(mistake("Lsystem: 1\ndefine: { external x; }\n") == "2:11: `external`, of sub-L-systems, is not supported yet");
}

TEST_CASE("parameters must be finite numbers") {
  CHECK(mistake_in("A(x) --> B(sqrt(0-x))") == "4:12: this parameter is not a number (nan)");
  CHECK(mistake_in("A(x) --> B(log(0))") == "4:12: this parameter is infinite");
  CHECK(mistake_in("A(x) --> B(10^100)") == "4:12: this parameter is 1e+100, too large for a module");
  CHECK(mistake(lsystem_text("A", "A --> B : 0-1\n", "seed: 1\n")) ==
        "5:11: a production's weight must not be negative, but is -1");
}

TEST_CASE("mistakes in words are found where they are") {
  CHECK_THROWS_WITH(parse_word("F\nF(1,nan)", "t.str"),
                    "t.str:2:5: this parameter is not a number (nan)\n  F(1,nan)\n      ^");
  CHECK(mistake_in_word("F(inf)") == "this parameter is infinite");
  CHECK(mistake_in_word("F(1e40)") == "this parameter is too large");
  CHECK(mistake_in_word("F(-1e999)") == "this parameter is too large");
  CHECK(mistake_in_word("F(1") == "this module's parameters lack their `)`");
  CHECK(mistake_in_word("F(1 2)") == "expected `,` or `)` after a parameter");
  CHECK(mistake_in_word("F()") == "expected a number");
  CHECK(mistake_in_word("F(x)") == "expected a number");
  CHECK(mistake_in_word("(1)") == "`(` without a module before it");
  CHECK(mistake_in_word("F)") == "`)` without a module before it");
  CHECK(mistake_in_word("\xC3\xA4") == "modules are single visible ASCII characters");
  CHECK(mistake_in_word("F]") == "this `]` lacks its `[`");
  CHECK(mistake_in_word("F[F") == "this `[` lacks its `]`");
}

TEST_CASE("brackets without a partner are found when a derived word is drawn") {
  const auto drawn = [](const std::string& axiom) {
    return interpret(derive(parse_grammar(lsystem_text(axiom, ""), "test.l")));
  };
  CHECK_THROWS_WITH(drawn("F]F"), "module 2 of the word, `]`: this `]` lacks its `[`");
  CHECK_THROWS_WITH(drawn("F[[F]"), "module 2 of the word, `[`: this `[` lacks its `]`");
}

TEST_CASE("widths that no segment can have are refused") {
  CHECK(mistake_in_word("!(0)F") == "module 2 of the word, `F`: a segment begins with width 0 here");
  CHECK(mistake_in_word("!(-1)F") == "module 2 of the word, `F`: a segment begins with the negative width -1 here");
  CHECK(mistake_in_word("F!(-1)F") == "module 3 of the word, `F`: a segment ends with the negative width -1 here");
  CHECK(mistake_in_word("@D(1e38)!(1e38)@D(1)F") == "none");
  CHECK(
      mistake_in_word("@Di(1e38)@Di(1e38)@Di(1e38)@Di(1e38)@Di(1e38)@Di(1e38)@Di(1e38)@Di(1e38)@Di(1e38)!(1)@D(1)F") ==
      "module 31 of the word, `F`: a segment begins with infinite width here");
}

TEST_CASE("positions that are not finite are refused") {
  std::string far;
  for (int i = 0; i < 9; ++i) far += "@Di(1e38)";
  CHECK(mistake_in_word(far + "F").find("infinitely far away") != std::string::npos);
  CHECK(mistake_in_word(far + "f@D(1)@O(1)").find("infinitely far away") != std::string::npos);
}
