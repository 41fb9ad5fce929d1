// Results are those of cpfg itself.

#include <catch2/catch.hpp>

#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

TEST_CASE("without steps the axiom is the result") {
  CHECK(grown("Lsystem: 1\naxiom: AB\nA --> B\nendlsystem\n") == "AB");
}

TEST_CASE("a module matches by symbol and number of parameters") {
  CHECK(rewritten("A(1)A(5)A", "A(x):x>3 --> p\nA(x) --> q\n") == "qpA");
  CHECK(rewritten("AA(1)A(1,2)", "A --> a\nA(x) --> b\nA(x,y) --> c\n") == "abc");
}

TEST_CASE("the first production that applies is taken") {
  CHECK(rewritten("A(4)", "A(x) : x<3 --> a\nA(x) : x<5 --> b\nA(x) --> c\n") == "b");
}

TEST_CASE("a predecessor of several modules takes them all") {
  CHECK(rewritten("ABABA", "AB --> x\nA --> y\n") == "xxy");
  CHECK(rewritten("A(1)B(2)A(3)", "A(x)B(y) --> C(x+y)\n") == "C(3)A(3)");
}

TEST_CASE("commands of several characters are several modules") {
  CHECK(rewritten("@O(1)~l(2)O(3)", "O(x)-->O(x+1)\nl(x)-->l(x*2)\n") == "@O(2)~l(4)O(4)");
}

TEST_CASE("blanks between modules do not matter and a tab continues a line") {
  CHECK(rewritten("A ( 1 ) B", "A(x)-->A ( x , x )\n\tB\n") == "A(1,1)BB");
}

TEST_CASE("statements before and after the condition compute for the successor") {
  CHECK(rewritten("A(4)", "A(y): {x=y/2; s=x*x;} s<10 {z=s+1;} --> B(x,s,z)\n") == "B(2,4,5)");
}

TEST_CASE("statements before a condition run even if it fails, those after it do not") {
  const std::string text = lsystem_text("AC", "A : {tried=tried+1;} 0 {done=done+1;} --> B\nC --> C(tried,done)\n",
                                        "start: {tried=0; done=0;}\n");
  CHECK(grown(text) == "AC(1,0)");
}

TEST_CASE("a cut removes the rest of its branch in the next step") {
  CHECK(rewritten("F[AF%FB[C]D]E%G", "") == "F[AF]E");
  const std::string text = lsystem_text("[AFF]G", "A --> %\n");
  CHECK(grown(text, 1) == "[%FF]G");
  CHECK(grown(text, 2) == "[]G");
}

TEST_CASE("a left context is found across brackets") {
  CHECK(rewritten("A[X][Y[B]C]D", "Y < C --> c\nA < D --> d\n") == "A[X][Y[B]c]d");
}

TEST_CASE("a right context passes over whole branches") {
  CHECK(rewritten("A[B[C]D]E", "A > E --> a\n") == "a[B[C]D]E");
  CHECK(rewritten("A[BCD]E", "A > [B]E --> a\n") == "A[BCD]E");
  CHECK(rewritten("A[BCD]E", "A > [B=]E --> a\n") == "a[BCD]E");
  CHECK(rewritten("A[BCD][XY]E", "A > [B=][X=]E --> a\n") == "a[BCD][XY]E");
  CHECK(rewritten("[A]E", "A > E --> a\n") == "[A]E");
}

TEST_CASE("contexts can have parameters") {
  CHECK(rewritten("A(1)B(2)C(3)", "A(x)<B(y)>C(z): x+y+z>5 --> D(x,y,z)\n") == "A(1)D(1,2,3)C(3)");
  CHECK(rewritten("B", "* < B > * --> C\n") == "C");
}

TEST_CASE("contexts pass over what is ignored or not considered, brackets too") {
  CHECK(rewritten("AxyB", "A < B --> b\n", "ignore: xy\n") == "Axyb");
  CHECK(rewritten("A[E]", "A > E --> a\n", "consider: AE\n") == "a[E]");
  CHECK(rewritten("A[E]", "A > E --> a\n", "consider: AE[]\n") == "A[E]");
}

TEST_CASE("a decomposition works on successors at once, depth first") {
  CHECK(rewritten("A(3)", "\ndecomposition\nmaximum depth: 2\nA(n):n>0 --> FA(n-1)\n") == "FFA(1)");
  CHECK(rewritten("A", "A --> B\ndecomposition\nB --> CC\n") == "CC");
  CHECK(grown(lsystem_text("B", "A --> B\ndecomposition\nB --> CC\n"), 0) == "B");
}

TEST_CASE("a homomorphism replaces what the turtle sees, down to its depth") {
  std::vector<std::string> notes;
  CHECK(interpreted("BB", "maximum depth: 2\nB --> [C]B\n", &notes) == "[C][C]B[C][C]B");
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("maximum depth") != std::string::npos);
}

TEST_CASE("a homomorphism takes contexts from the original word") {
  std::vector<std::string> notes;
  CHECK(interpreted("FFE", "F > E --> G\nF > F --> HF\n", &notes) == "HFGE");
}

TEST_CASE("a homomorphism sees the variables and random numbers that the derivation left") {
  const Grammar grammar = parse_grammar(
      lsystem_text("A(ran(1))B", "\nhomomorphism\nB --> C(ran(1),k)\n", "start: { srand(5); }\nend each: { k = 7; }\n"),
      "test.l");
  CHECK(to_string(apply_homomorphism(derive(grammar), grammar)) == "A(0.52484)C(0.272854,7)");
}

TEST_CASE("the words for empty contexts, conditions and successors are stars") {
  CHECK(rewritten("AB", "A : * --> *\nB : {x=1;} * {y=x;} --> C(y)\n") == "C(1)");
}

TEST_CASE("modules remember the step that made them") {
  const Word word =
      derive(parse_grammar("Lsystem: 1\nderivation length: 3\naxiom: XA\nA --> FA\nendlsystem\n", "test.l"));
  REQUIRE(to_string(word) == "XFFFA");
  const std::vector<int> births{0, 1, 2, 3, 3};
  for (std::size_t i = 0; i < births.size(); ++i) CHECK(word.modules[i].birth_step == births[i]);
}

TEST_CASE("the same L-system gives the same word again") {
  const std::string text = lsystem_text(std::string(50, 'A'), "A-->a(nran(0,1)):1\nA-->b(ran(1)):2\n", "seed: 3\n");
  CHECK(grown(text) == grown(text));
}
