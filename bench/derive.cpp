// How long does it take to derive 10 million modules, and how much memory?

#include "lsystem/derive.h"
#include "bench/support/machine.h"
#include "bench/support/study.h"
#include "bench/support/timing.h"

namespace barkridge::bench {

namespace {

// A ternary tree as modellers write them: parameters, expressions, a condition, and segments that grow at every step.
constexpr const char* kTree = R"(
Lsystem: 1
derivation length: 13
axiom: A(100,10)
A(l,w) : l>0.01 --> !(w)F(l)[&(30)/(10)A(l*0.9,w*0.707)]/(137.5)[&(40)A(l*0.7,w*0.707)]/(137.5)[+(20)B(l*0.8)]A(l*0.95,w*0.9)
F(l) --> F(l*1.05)
!(w) : w<50 --> !(w*1.1)
B(x) --> ~l(x*0.1)
endlsystem
)";

void measure(Study& study) {
  const Stopwatch watch;
  const Word word = derive(parse_grammar(kTree, "tree.l"));
  const double seconds = watch.seconds();
  study.add({.title = "Derivation of a ternary tree",
             .columns = {"modules", "parameters", "s", "peak MB"},
             .rows = {{word.modules.size(), word.parameters.size(), seconds, megabytes(peak_memory())}},
             .notes = {}});
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  return run_study(
      argc, argv, Study("derive", "How long does it take to derive 10 million modules, and how much memory?"),
      [](CLI::App&) {}, measure);
}
