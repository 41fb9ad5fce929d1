// How long does it take to derive 10 million modules, and how much memory?

#include <sys/resource.h>

#include <chrono>
#include <cstdio>

#include "lsystem/derive.h"

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

}  // namespace

int main() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const barkridge::Word word = barkridge::derive(barkridge::parse_grammar(kTree, "tree.l"));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%zu modules, %zu parameters: %.2f s, %.0f MB peak\n", word.modules.size(), word.parameters.size(),
              seconds, static_cast<double>(usage.ru_maxrss) / 1024);
}
