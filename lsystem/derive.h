#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/progress.h"
#include "lsystem/grammar.h"
#include "lsystem/notify.h"
#include "lsystem/word.h"

namespace barkridge {

struct DeriveOptions {
  /// Derivation steps; by default what the L-system's `derivation length:` says. `Z` keeps that length.
  std::optional<int> steps;
  /// A time in steps, not negative: takes only the steps that have begun by then, the first at time 0, and is what
  /// `GetTime(0)` is. Without it all steps are taken, and their number is the time.
  std::optional<double> time;
  /// Whether the word keeps the branches that `%` removes (`Word::cuts`). They count in `max_memory`.
  bool keep_cuts = false;
  /// Replaces the L-system's `seed:`, which starts the random choice of productions, and acts like `srand(seed)` before
  /// the first statement. Without `seed:` in the text, only productions with weights are chosen at random.
  std::optional<std::int64_t> seed;
  /// Most modules a word may have in any step. Checked while a step grows, before the memory is taken.
  std::size_t max_modules = 50'000'000;
  /// Most bytes for the words of one step.
  std::size_t max_memory = std::size_t{4} << 30;
  Progress progress;
  Notify notify;
};

/// Rewrites the axiom. Random numbers are those of cpfg, bit for bit (docs/lsystem_language.md).
/// Throws `LimitError`, naming the step and the limit, before a word exceeds it, and `InputError` where a parameter
/// becomes infinite or not a number.
Word derive(const Grammar& grammar, const DeriveOptions& options = {});

}  // namespace barkridge
