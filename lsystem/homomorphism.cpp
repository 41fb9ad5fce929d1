#include "lsystem/homomorphism.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace barkridge {

namespace {

// Each level holds a successor in memory.
constexpr std::size_t kMaxDepth = 100'000;

}  // namespace

InterpretedModules::InterpretedModules(const Word& word, const Grammar* grammar, std::size_t max_modules,
                                       Notify listener)
    : word_(word), grammar_(grammar == nullptr ? nullptr : &grammar->definition()), modules_left_(max_modules) {
  levels_.push_back({&word, 0, {}});
  if (grammar_ == nullptr || grammar_->homomorphism.empty()) return;
  if (word.state) {
    machine_.emplace(*grammar_, std::move(listener), *word.state);
  } else {
    machine_.emplace(*grammar_, std::move(listener));
    machine_->run(grammar_->define);
    machine_->run(grammar_->start);
  }
  matcher_.emplace(*grammar_, *machine_);
  matcher_->set_context_word(word);
  if (grammar_->homomorphism_seed) own_stream_ = Drand48::seeded(*grammar_->homomorphism_seed);
}

bool InterpretedModules::next() {
  for (;;) {
    Level& level = levels_[depth_];
    if (level.position == level.source->modules.size()) {
      if (depth_ == 0) return false;
      if (--depth_ == 0) swap_streams();
      continue;
    }
    if (depth_ == 0) origin_ = level.position;
    if (machine_ && expand()) continue;
    source_ = level.source;
    position_ = level.position++;
    return true;
  }
}

/// Replaces the next module by a level of its own, if a production applies to it.
bool InterpretedModules::expand() {
  const ProductionSet& set = grammar_->homomorphism;
  Level& level = levels_[depth_];
  const Production* const production = matcher_->find_inside(set, *level.source, level.position, origin_, origin_ + 1);
  if (production == nullptr) return false;
  if (static_cast<std::int64_t>(depth_) >= set.maximum_depth) {
    if (set.warnings) machine_->warn(production->place, "the homomorphism's maximum depth is reached here");
    return false;
  }
  level.position += production->predecessor.size();
  if (depth_ == 0) swap_streams();
  ++depth_;
  if (depth_ > kMaxDepth) {
    throw LimitError(
        fmt::format("the homomorphism is more than {} levels deep; lower its `maximum depth:`", kMaxDepth));
  }
  if (production->successor.size() > modules_left_) {
    throw LimitError("the homomorphism makes more modules than --max-modules allows");
  }
  modules_left_ -= production->successor.size();
  if (levels_.size() <= depth_) levels_.push_back({nullptr, 0, {}});

  Level& deeper = levels_[depth_];
  deeper.source = &deeper.made;
  deeper.position = 0;
  deeper.made.modules.clear();
  deeper.made.parameters.clear();
  machine_->run(production->after);
  append_modules(production->successor, *machine_, word_.modules[origin_].birth_step, deeper.made);
  return true;
}

void InterpretedModules::swap_streams() {
  if (own_stream_) std::swap(*own_stream_, machine_->state.random.uniform);
}

const Word::Module* InterpretedModules::operand(std::size_t ahead) const {
  const std::size_t after = levels_[depth_].position + ahead;
  return after < source_->modules.size() ? &source_->modules[after] : nullptr;
}

void InterpretedModules::take_operand() { position_ = levels_[depth_].position++; }

void InterpretedModules::skip_branch() {
  std::size_t& position = levels_[depth_].position;
  for (std::size_t nested = 0; position < source_->modules.size(); ++position) {
    const char symbol = source_->modules[position].symbol;
    if (symbol == ']' && nested-- == 0) return;
    if (symbol == '[') ++nested;
  }
}

Word apply_homomorphism(const Word& word, const Grammar& grammar, std::size_t max_modules, const Notify& listener) {
  InterpretedModules modules(word, &grammar, max_modules, listener);
  Word result;
  while (modules.next()) {
    if (result.modules.size() >= max_modules) {
      throw LimitError(
          fmt::format("the homomorphism makes more than {} modules; --max-modules raises this limit", max_modules));
    }
    const std::span<const float> values = modules.parameters();
    Word::Module module = modules.module();
    module.first_parameter = static_cast<std::uint32_t>(result.parameters.size());
    result.modules.push_back(module);
    result.parameters.insert(result.parameters.end(), values.begin(), values.end());
  }
  return result;
}

}  // namespace barkridge
