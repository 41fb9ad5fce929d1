#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "lsystem/grammar.h"
#include "lsystem/word.h"

namespace barkridge {

struct DeriveOptions {
    /// Derivation steps; by default what the L-system's `derivation length:` says.
    std::optional<int> steps;
    /// Seed of the stochastic choice; by default the L-system's `seed:`.
    std::optional<std::int64_t> seed;
    /// Most modules a word may have in any step. Checked while a step grows, before the memory is taken.
    std::size_t max_modules = 50'000'000;
    /// Most bytes for the words of one step.
    std::size_t max_memory = std::size_t{4} << 30;
    Progress progress;
};

/// Rewrites the axiom. Random numbers are those of cpfg, bit for bit (docs/lsystem_language.md).
/// Throws `LimitError`, naming the step and the limit, before a word exceeds it.
Word derive(const Grammar& grammar, const DeriveOptions& options = {});

}  // namespace barkridge
