#include "lsystem/derive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "lsystem/grammar_definition.h"
#include "lsystem/machine.h"
#include "lsystem/matching.h"

namespace barkridge {

namespace {

// Each level of a decomposition holds a successor in memory.
constexpr std::size_t kMaxDecompositionDepth = 100'000;
constexpr std::size_t kModulesPerReport = 1 << 16;

bool has_weights(const ProductionSet& set) {
  return std::any_of(set.productions.begin(), set.productions.end(),
                     [](const Production& production) { return !production.weight.empty(); });
}

std::size_t count_parameters(const std::vector<ModuleTemplate>& modules) {
  std::size_t count = 0;
  for (const ModuleTemplate& module : modules) count += module.parameters.size();
  return count;
}

std::size_t bytes(std::size_t modules, std::size_t parameters) {
  return modules * sizeof(Word::Module) + parameters * sizeof(float);
}

class Derivation {
 public:
  Derivation(const GrammarDefinition& grammar, const DeriveOptions& options)
      : grammar_(grammar), options_(options), machine_(grammar, options.notify), matcher_(grammar, machine_) {
    stochastic_ = grammar.seed.has_value();
    if (options.seed) {
      stochastic_ = stochastic_ || has_weights(grammar.productions);
      machine_.state.random.choice = Drand48();
      machine_.state.random.seed_choice(*options.seed);
      machine_.state.random.seed_uniform(*options.seed);
    }
    machine_.state.time = options.time.value_or(options.steps.value_or(grammar.derivation_length));
  }

  Word run() {
    machine_.run(grammar_.define);
    machine_.run(grammar_.start);
    append(grammar_.axiom);
    machine_.state.stopped = false;
    while (step_ < last_step() && !machine_.state.stopped) {  // statements may change both
      ++step_;
      std::swap(current_, next_);
      next_.modules.clear();
      next_.parameters.clear();
      rewrite();
    }
    report(options_.progress, 1);
    if (!options_.time) machine_.state.time = step_;
    next_.state = std::make_shared<const MachineState>(std::move(machine_.state));
    return std::move(next_);
  }

 private:
  int last_step() const {
    const int length = options_.steps.value_or(machine_.state.derivation_length);
    return options_.time && *options_.time < length ? static_cast<int>(std::ceil(*options_.time)) : length;
  }

  void rewrite() {
    machine_.state.slots[kStepSlot] = step_;
    machine_.run(grammar_.start_each);
    matcher_.set_context_word(current_);
    std::size_t next_report = 0;
    for (std::size_t i = 0; i < current_.modules.size();) {
      if (i >= next_report) {
        const double part = static_cast<double>(i) / static_cast<double>(current_.modules.size());
        report(options_.progress, (step_ - 1 + part) / last_step());
        next_report = i + kModulesPerReport;
      }
      carry_cuts(i);
      i = rewrite_module(i);
    }
    carry_cuts(current_.modules.size());
    current_.cuts.clear();
    carried_cuts_ = 0;
    machine_.run(grammar_.end_each);
    if (step_ == last_step()) machine_.run(grammar_.end);
  }

  /// Rewrites what stands at `position` of the current word; returns the position after it.
  std::size_t rewrite_module(std::size_t position) {
    const Production* const production =
        stochastic_ ? matcher_.draw(grammar_.productions, position) : matcher_.find(grammar_.productions, position);
    if (production != nullptr) {
      const std::size_t after = position + production->predecessor.size();
      machine_.run(production->after);
      if (grammar_.decomposition.empty()) {
        append(production->successor);
      } else {
        fill_level(0, production->successor);
        decompose(0, position, after);
      }
      return after;
    }
    if (grammar_.decomposition.maximum_depth > 0) {
      const Production* const decomposition =
          matcher_.find_inside(grammar_.decomposition, current_, position, position, position + 1);
      if (decomposition != nullptr) {
        machine_.run(decomposition->after);
        fill_level(1, decomposition->successor);
        decompose(1, position, position + 1);
        return position + decomposition->predecessor.size();
      }
    }
    const Word::Module& module = current_.modules[position];
    if (module.symbol == '%' && module.parameter_count == 0) return cut(position + 1);
    make_room(1, module.parameter_count);
    append_copy(current_, position, next_);
    return position + 1;
  }

  // Branches that `%` removes.

  /// Removes what is left of a branch from `position` on; returns the position after it.
  std::size_t cut(std::size_t position) {
    const std::size_t end = end_of_cut(position);
    if (!options_.keep_cuts || end == position) return end;
    auto branch = std::make_shared<Word>();
    for (std::size_t i = position; i <= end; ++i) {
      restore_cuts(i, *branch);
      if (i < end) append_copy(current_, i, *branch);
      if (held_bytes() + bytes_of(*branch) > options_.max_memory) refuse_memory();
    }
    cut_bytes_ += bytes_of(*branch);
    next_.cuts.push_back({next_.modules.size(), step_, std::move(branch)});
    return end;
  }

  /// Puts what was cut at a position of the current word back, into the branch with which it now goes.
  void restore_cuts(std::size_t position, Word& branch) {
    for (; carried_cuts_ < current_.cuts.size() && current_.cuts[carried_cuts_].position == position; ++carried_cuts_) {
      const Word& earlier = *current_.cuts[carried_cuts_].branch;
      branch.modules.push_back({'[', 0, birth_step(), 0});
      for (std::size_t i = 0; i < earlier.modules.size(); ++i) append_copy(earlier, i, branch);
      branch.modules.push_back({']', 0, birth_step(), 0});
      cut_bytes_ -= bytes_of(earlier);
    }
  }

  /// Earlier cuts that stand at or before this position of the current word stand at the next word's end.
  void carry_cuts(std::size_t position) {
    for (; carried_cuts_ < current_.cuts.size() && current_.cuts[carried_cuts_].position <= position; ++carried_cuts_) {
      next_.cuts.push_back(std::move(current_.cuts[carried_cuts_]));
      next_.cuts.back().position = next_.modules.size();
    }
  }

  static std::size_t bytes_of(const Word& word) { return bytes(word.modules.capacity(), word.parameters.capacity()); }

  /// The `]` that ends the branch which `%` cuts, or the end of the word.
  std::size_t end_of_cut(std::size_t position) const {
    for (std::size_t depth = 0; position < current_.modules.size(); ++position) {
      const char symbol = current_.modules[position].symbol;
      if (symbol == ']' && depth-- == 0) break;
      if (symbol == '[') ++depth;
    }
    return position;
  }

  // Decomposition: depth first, each level's modules in a word of their own.

  struct Level {
    Word word;
    std::size_t position = 0;
  };

  void fill_level(std::size_t depth, const std::vector<ModuleTemplate>& successor) {
    if (depth > kMaxDecompositionDepth) {
      throw LimitError(fmt::format("step {}: the decomposition is more than {} levels deep; lower its `maximum depth:`",
                                   step_, kMaxDecompositionDepth));
    }
    if (levels_.size() <= depth) levels_.resize(depth + 1);
    Level& level = levels_[depth];
    level.word.modules.clear();
    level.word.parameters.clear();
    level.position = 0;
    append_modules(successor, machine_, birth_step(), level.word);
  }

  /// Decomposes the modules of level `base`, which is also their depth, into the next word. Their context is that of
  /// the module in the current word, which stands before `right` and not before `left`.
  void decompose(std::size_t base, std::size_t left, std::size_t right) {
    const ProductionSet& set = grammar_.decomposition;
    for (std::size_t depth = base;;) {
      Level& level = levels_[depth];
      if (level.position == level.word.modules.size()) {
        if (depth == base) return;
        --depth;
        continue;
      }
      const Production* const production = matcher_.find_inside(set, level.word, level.position, left, right);
      if (production == nullptr || static_cast<std::int64_t>(depth) >= set.maximum_depth) {
        if (production != nullptr && set.warnings) {
          machine_.warn(production->place, "the decomposition's maximum depth is reached here");
        }
        make_room(1, level.word.modules[level.position].parameter_count);
        append_copy(level.word, level.position, next_);
        ++level.position;
      } else {
        machine_.run(production->after);
        level.position += production->predecessor.size();
        fill_level(++depth, production->successor);
      }
    }
  }

  // The next word.

  std::uint16_t birth_step() const {
    return static_cast<std::uint16_t>(std::min<int>(step_, std::numeric_limits<std::uint16_t>::max()));
  }

  void append(const std::vector<ModuleTemplate>& modules) {
    make_room(modules.size(), count_parameters(modules));
    append_modules(modules, machine_, birth_step(), next_);
  }

  /// Makes sure that the next word can take so many more modules and parameters, within the limits.
  void make_room(std::size_t modules, std::size_t parameters) {
    modules += next_.modules.size();
    parameters += next_.parameters.size();
    if (modules > options_.max_modules) {
      throw LimitError(fmt::format("step {}: the word would have more than {} modules; --max-modules raises this limit",
                                   step_, options_.max_modules));
    }
    if (modules > next_.modules.capacity()) grow(next_.modules, modules);
    if (parameters > next_.parameters.capacity()) grow(next_.parameters, parameters);
  }

  template <typename T>
  void grow(std::vector<T>& array, std::size_t needed) {
    // While an array moves to a larger place, the old one still takes memory.
    const std::size_t held = held_bytes();
    const auto fits = [&](std::size_t capacity) {
      return held <= options_.max_memory && capacity <= (options_.max_memory - held) / sizeof(T) &&
             capacity <= std::numeric_limits<std::uint32_t>::max();
    };
    std::size_t capacity = std::max<std::size_t>({needed, 2 * array.capacity(), 1024});
    if (!fits(capacity)) capacity = needed + needed / 16;
    if (!fits(capacity)) capacity = needed;
    if (!fits(capacity)) refuse_memory();
    array.reserve(capacity);
  }

  std::size_t held_bytes() const {
    return bytes(current_.modules.capacity(), current_.parameters.capacity()) +
           bytes(next_.modules.capacity(), next_.parameters.capacity()) + cut_bytes_;
  }
  [[noreturn]] void refuse_memory() const {
    throw LimitError(
        fmt::format("step {}: the words would take more than {} MB of memory; --max-memory raises this limit", step_,
                    options_.max_memory >> 20));
  }

  const GrammarDefinition& grammar_;
  const DeriveOptions& options_;
  Machine machine_;
  Matcher matcher_;
  bool stochastic_ = false;
  int step_ = 0;
  Word current_;
  Word next_;
  std::size_t carried_cuts_ = 0;  // of the current word's
  std::size_t cut_bytes_ = 0;
  std::vector<Level> levels_;
};

}  // namespace

Word derive(const Grammar& grammar, const DeriveOptions& options) {
  if (options.steps.value_or(0) < 0) throw InputError("the number of derivation steps must not be negative");
  if (!(options.time.value_or(0) >= 0)) throw InputError("the time of a derivation must not be negative");
  return Derivation(grammar.definition(), options).run();
}

}  // namespace barkridge
