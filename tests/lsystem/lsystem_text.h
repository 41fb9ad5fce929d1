#pragma once
// L-systems written in a line or two.

#include <string>
#include <vector>

#include "lsystem/derive.h"
#include "lsystem/grammar.h"
#include "lsystem/homomorphism.h"
#include "lsystem/word.h"

namespace barkridge {

/// An L-system of one step: `items` stand before the axiom and `productions` after it, each with a newline at its end.
inline std::string lsystem_text(const std::string& axiom, const std::string& productions,
                                const std::string& items = "") {
  return "Lsystem: 1\nderivation length: 1\n" + items + "axiom: " + axiom + "\n" + productions + "\nendlsystem\n";
}

/// The word after `steps` steps, or after the L-system's own number of them.
inline std::string grown(const std::string& text, std::optional<int> steps = {}) {
  DeriveOptions options;
  options.steps = steps;
  return to_string(derive(parse_grammar(text, "test.l"), options));
}

inline std::string rewritten(const std::string& axiom, const std::string& productions, const std::string& items = "") {
  return grown(lsystem_text(axiom, productions, items));
}

/// The value of an expression, as `%g` prints it.
inline std::string value_of(const std::string& expression, const std::string& items = "") {
  const std::string word = grown(lsystem_text("A(" + expression + ")", "", items), 0);
  return word.substr(2, word.size() - 3);
}

/// What the turtle sees of the axiom.
inline std::string interpreted(const std::string& axiom, const std::string& homomorphism,
                               std::vector<std::string>* notes) {
  const Grammar grammar = parse_grammar(lsystem_text(axiom, "\nhomomorphism\n" + homomorphism), "test.l");
  DeriveOptions options;
  options.steps = 0;
  const Notify listener = [&](const std::string& message) { notes->push_back(message); };
  return to_string(apply_homomorphism(derive(grammar, options), grammar, 1000, listener));
}

}  // namespace barkridge
