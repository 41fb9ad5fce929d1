#pragma once
// A parsed L-system as the rest of this room uses it. Other rooms see the opaque `Grammar`.

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lsystem/program.h"
#include "lsystem/source_text.h"

namespace barkridge {

/// Modules are single ASCII characters.
inline constexpr std::size_t kSymbolCount = 128;

/// An array's numbers stand in slots from `first_slot` on, row-major.
struct ArrayVariable {
  std::string name;
  std::vector<std::uint32_t> sizes;
  std::uint32_t first_slot = 0;
};

/// A module of a predecessor or context: matches the symbol with as many parameters as `slots`, and puts them there.
struct ModulePattern {
  char symbol = 0;
  std::vector<std::uint32_t> slots;
};

/// A module to make.
struct ModuleTemplate {
  char symbol = 0;
  std::vector<Program> parameters;
};

struct Production {
  std::vector<ModulePattern> left_context;  ///< innermost module last, as written
  std::vector<ModulePattern> predecessor;
  std::vector<ModulePattern> right_context;
  Program before;     ///< run at every match
  Program condition;  ///< empty means true
  Program after;      ///< run when the condition holds, before the successor
  std::vector<ModuleTemplate> successor;
  Program weight;  ///< empty means 1
  std::uint32_t place = 0;
};

/// The productions of an L-system, its decomposition or its homomorphism, in the author's order.
struct ProductionSet {
  std::vector<Production> productions;
  /// The productions whose predecessor begins with a symbol.
  std::array<std::vector<std::uint32_t>, kSymbolCount> by_symbol;
  bool has_contexts = false;
  int maximum_depth = 1;
  bool warnings = true;

  bool empty() const { return productions.empty(); }
};

struct GrammarDefinition {
  SourceText source;
  std::string label;
  int derivation_length = 0;
  /// `seed:` makes the L-system stochastic.
  std::optional<std::int64_t> seed;
  /// Symbols that contexts pass over.
  std::bitset<kSymbolCount> ignored;
  std::vector<ModuleTemplate> axiom;
  Program define, start, end, start_each, end_each;
  ProductionSet productions;
  ProductionSet decomposition;
  ProductionSet homomorphism;
  /// The homomorphism's own random stream; none if absent or negative.
  std::optional<std::int64_t> homomorphism_seed;

  std::vector<ArrayVariable> arrays;
  std::vector<std::string> strings;
  /// Variables of all scopes: a production's own keep their values from one use to the next.
  std::uint32_t slot_count = 2;
};

/// The slots of the predefined variables: the current step and the derivation length.
inline constexpr std::uint32_t kStepSlot = 0;
inline constexpr std::uint32_t kLengthSlot = 1;

}  // namespace barkridge
