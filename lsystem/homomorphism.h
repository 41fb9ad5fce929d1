#pragma once
// The modules that the turtle sees: those of a word, each replaced by what the homomorphism makes of it.

#include <cstddef>
#include <deque>
#include <optional>
#include <span>

#include "lsystem/grammar.h"
#include "lsystem/machine.h"
#include "lsystem/matching.h"
#include "lsystem/notify.h"
#include "lsystem/word.h"

namespace barkridge {

/// Reads a word module after module and applies the homomorphism on the way, so that no second word is in memory. The
/// word and the grammar must outlive it.
class InterpretedModules {
 public:
  /// Without a grammar the word is read as it is. Throws `LimitError` once the homomorphism has made more than
  /// `max_modules` modules.
  InterpretedModules(const Word& word, const Grammar* grammar, std::size_t max_modules, Notify listener);

  /// Goes to the next module. False at the end.
  bool next();
  /// The module that stands after the present one, or `ahead` further, and came from the same successor (or both from
  /// the word); nullptr if there is none. It is as it stands there: the homomorphism does not apply to the letter of
  /// `~l`.
  const Word::Module* operand(std::size_t ahead = 0) const;
  /// Makes the operand next to it the present module.
  void take_operand();
  /// Goes to before the `]` that ends this branch in the same successor, or to the successor's end.
  void skip_branch();

  const Word::Module& module() const { return source_->modules[position_]; }
  std::span<const float> parameters() const { return source_->parameters_of(module()); }
  /// The index in the word of the module that the present one came from.
  std::size_t origin() const { return origin_; }

 private:
  struct Level {
    const Word* source;  // the word itself, or `made`
    std::size_t position;
    Word made;
  };

  bool expand();
  void swap_streams();

  const Word& word_;
  const GrammarDefinition* grammar_;
  std::optional<Machine> machine_;
  std::optional<Matcher> matcher_;
  std::optional<Drand48> own_stream_;  // of a homomorphism with a seed, while not in use
  std::size_t modules_left_;
  std::deque<Level> levels_;  // their addresses are stable
  std::size_t depth_ = 0;
  const Word* source_ = nullptr;
  std::size_t position_ = 0;
  std::size_t origin_ = 0;
};

/// The whole word that the turtle would see. Not needed for drawing.
Word apply_homomorphism(const Word& word, const Grammar& grammar, std::size_t max_modules = 50'000'000,
                        const Notify& listener = {});

}  // namespace barkridge
