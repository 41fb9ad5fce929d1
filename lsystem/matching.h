#pragma once
// Which production applies at a module of a word.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lsystem/grammar_definition.h"
#include "lsystem/machine.h"
#include "lsystem/word.h"

namespace barkridge {

/// Matches productions in the words of one derivation or interpretation.
class Matcher {
 public:
  Matcher(const GrammarDefinition& grammar, Machine& machine) : grammar_(grammar), machine_(machine) {}

  /// The word in which contexts are looked up. Must outlive its use. Finds the partner of each bracket, in linear time,
  /// if there are contexts at all.
  void set_context_word(const Word& word);

  /// The first production of the set that applies to the context word from `position` on, or nullptr. Runs the
  /// statements before conditions, and leaves the parameters of the match in their slots.
  const Production* find(const ProductionSet& set, std::size_t position);
  /// The same for the modules of another word that came from the context word's: their context is what stands there to
  /// the left of `left` and from `right` on.
  const Production* find_inside(const ProductionSet& set, const Word& word, std::size_t position, std::size_t left,
                                std::size_t right);

  /// Draws among all productions that apply, as cpfg does: every module of a stochastic L-system takes one random
  /// number, whether productions apply or not.
  const Production* draw(const ProductionSet& set, std::size_t position);

 private:
  bool applies(const Production& production, const Word& word, std::size_t position, std::size_t left,
               std::size_t right);
  bool matches_left(const std::vector<ModulePattern>& context, std::size_t position);
  bool matches_right(const std::vector<ModulePattern>& context, std::size_t position);
  /// The unmatched `]` at or after `position`, or the word's length.
  std::size_t end_of_branch(std::size_t position) const;
  void load(const ModulePattern& pattern, const Word& word, std::size_t position);
  float weight(const Production& production);

  struct Match {
    const ModulePattern* pattern;
    std::size_t position;
  };
  struct Candidate {
    const Production* production;
    float weight;
  };

  const GrammarDefinition& grammar_;
  Machine& machine_;
  const Word* context_word_ = nullptr;
  std::vector<std::uint32_t> partners_;
  std::vector<Match> context_matches_;
  std::vector<Candidate> candidates_;
};

/// Evaluates a successor's modules and appends them to the word.
void append_modules(const std::vector<ModuleTemplate>& modules, Machine& machine, std::uint16_t birth_step, Word& word);
/// Appends a copy of a module of another word.
void append_copy(const Word& from, std::size_t position, Word& word);

/// For each `[` the position of its `]` and the other way round; the word's length for brackets without a partner, 0
/// for other modules.
std::vector<std::uint32_t> bracket_partners(const Word& word);

}  // namespace barkridge
