// The numbers were printed by cpfg itself.

#include <catch2/catch.hpp>

#include "lsystem/random_streams.h"
#include "tests/lsystem/lsystem_text.h"

using namespace barkridge;

TEST_CASE("srand(5) starts the stream that cpfg draws") {
  RandomStreams streams;
  streams.seed_uniform(5);
  CHECK(streams.uniform.next() == Approx(0.52483958).margin(5e-9));
  CHECK(streams.uniform.next() == Approx(0.27285430).margin(5e-9));
  CHECK(streams.uniform.next() == Approx(0.78859947).margin(5e-9));
  CHECK(streams.uniform.next() == Approx(0.19806924).margin(5e-9));
}

TEST_CASE("srand keeps 32 bits of its seed") {
  RandomStreams a, b;
  a.seed_uniform(5);
  b.seed_uniform(5 + (std::int64_t{1} << 32));
  CHECK(a.uniform.next() == b.uniform.next());
  b.seed_uniform(6);
  CHECK(a.uniform.next() != b.uniform.next());
}

TEST_CASE("normal numbers come in pairs from the same stream") {
  const std::string items = "start: { srand(5); }\n";
  CHECK(grown(lsystem_text("A(ran(1),nran(0,1),ran(1),nran(0,1),ran(1),nran(0,1))", "", items), 0) ==
        "A(0.52484,0.872942,0.198069,-0.68706,0.518233,-0.158285)");
}

TEST_CASE("before any srand the first normal number is the mean") {
  CHECK(grown(lsystem_text("A(nran(3,1),ran(1),nran(0,1))", ""), 0) == "A(3,0.170828,-0.387264)");
}

TEST_CASE("beta and binomial numbers are cpfg's") {
  const std::string items = "start: { srand(5); }\n";
  const std::string axiom = "A(bran(2,3),bran(2,3),bran(0.5,0.5),bran(5,16),biran(10,0.3),biran(100,0.5),ran(2))";
  CHECK(grown(lsystem_text(axiom, "", items), 0) == "A(0.415721,0.612157,0.536418,0.14785,3,52,1.96479)");
}

TEST_CASE("a seed starts the choice among productions") {
  const std::string productions = "A-->a:40\nA-->b:60\n";
  CHECK(rewritten("AAAAAAAAAA", productions, "seed: 5\n") == "bbabbabaaa");
  // Only 16 bits of the seed count.
  CHECK(rewritten("AAAAAAAAAA", productions, "seed: 65541\n") == "bbabbabaaa");
}

TEST_CASE("every module of a stochastic L-system takes a random number") {
  CHECK(rewritten("FAGA[A]A", "A-->a:40\nA-->b:60\n", "seed: 5\n") == "FbGb[a]a");
}

TEST_CASE("choices are drawn with their weights") {
  std::string axiom(10000, 'A');
  const std::string word = rewritten(axiom, "A-->a:2+1\nA-->b\nA-->c:0\n", "seed: 9\n");
  const auto count = [&](char symbol) { return std::count(word.begin(), word.end(), symbol); };
  CHECK(count('c') == 0);
  // Five standard deviations of a binomial number with p = 3/4.
  CHECK(std::abs(count('a') - 7500) < 217);
  CHECK(count('a') + count('b') == 10000);
}

TEST_CASE("without a seed the first match wins") { CHECK(rewritten("AAAA", "A-->a:1\nA-->b:1000\n") == "aaaa"); }

TEST_CASE("a seed from outside replaces the text's and drives ran") {
  const Grammar grammar = parse_grammar(lsystem_text("AAAAAAAAAA", "A-->a:40\nA-->b:60\n", "seed: 1\n"), "test.l");
  DeriveOptions options;
  options.seed = 5;
  CHECK(to_string(derive(grammar, options)) == "bbabbabaaa");
  const Grammar uniform = parse_grammar(lsystem_text("A", "A-->B(ran(1))\n"), "test.l");
  CHECK(to_string(derive(uniform, options)) == "B(0.52484)");
}

TEST_CASE("a homomorphism's seed starts a stream of its own at each interpretation") {
  std::vector<std::string> notes;
  const std::string text = "seed: 5\nA --> F(ran(1))F(ran(1))\n";
  CHECK(interpreted("AA", text, &notes) == "F(0.52484)F(0.272854)F(0.788599)F(0.198069)");
  CHECK(interpreted("AA", text, &notes) == "F(0.52484)F(0.272854)F(0.788599)F(0.198069)");
}
