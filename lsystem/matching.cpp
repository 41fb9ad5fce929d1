#include "lsystem/matching.h"

#include <fmt/format.h>

#include "base/error.h"

namespace barkridge {

namespace {

bool same(const ModulePattern& pattern, const Word::Module& module) {
  return pattern.symbol == module.symbol && pattern.slots.size() == module.parameter_count;
}

std::size_t symbol_index(const Word& word, std::size_t position) {
  return static_cast<std::size_t>(word.modules[position].symbol);
}

}  // namespace

void Matcher::set_context_word(const Word& word) {
  context_word_ = &word;
  const bool has_contexts =
      grammar_.productions.has_contexts || grammar_.decomposition.has_contexts || grammar_.homomorphism.has_contexts;
  if (has_contexts) partners_ = bracket_partners(word);
}

const Production* Matcher::find(const ProductionSet& set, std::size_t position) {
  for (const std::uint32_t index : set.by_symbol[symbol_index(*context_word_, position)]) {
    const Production& production = set.productions[index];
    const std::size_t right = position + production.predecessor.size();
    if (applies(production, *context_word_, position, position, right)) return &production;
  }
  return nullptr;
}

const Production* Matcher::find_inside(const ProductionSet& set, const Word& word, std::size_t position,
                                       std::size_t left, std::size_t right) {
  for (const std::uint32_t index : set.by_symbol[symbol_index(word, position)]) {
    const Production& production = set.productions[index];
    if (applies(production, word, position, left, right)) return &production;
  }
  return nullptr;
}

const Production* Matcher::draw(const ProductionSet& set, std::size_t position) {
  candidates_.clear();
  float total = 0;  // cpfg sums and compares in single precision
  for (const std::uint32_t index : set.by_symbol[symbol_index(*context_word_, position)]) {
    const Production& production = set.productions[index];
    const std::size_t right = position + production.predecessor.size();
    if (!applies(production, *context_word_, position, position, right)) continue;
    candidates_.push_back({&production, weight(production)});
    total += candidates_.back().weight;
  }
  auto rest = static_cast<float>(total * machine_.state.random.choice.next());
  for (const Candidate& candidate : candidates_) {
    rest -= candidate.weight;
    if (rest <= 0) return candidate.production;
  }
  return nullptr;
}

float Matcher::weight(const Production& production) {
  if (production.weight.empty()) return 1;
  const float weight = machine_.run_parameter(production.weight);
  if (weight < 0) {
    throw InputError(grammar_.source.place(first_place(production.weight)),
                     fmt::format("a production's weight must not be negative, but is {:g}", weight));
  }
  return weight;
}

bool Matcher::applies(const Production& production, const Word& word, std::size_t position, std::size_t left,
                      std::size_t right) {
  const std::vector<ModulePattern>& predecessor = production.predecessor;
  if (predecessor.size() > word.modules.size() - position) return false;
  for (std::size_t i = 0; i < predecessor.size(); ++i) {
    if (!same(predecessor[i], word.modules[position + i])) return false;
  }
  context_matches_.clear();
  if (!matches_right(production.right_context, right) || !matches_left(production.left_context, left)) return false;

  for (std::size_t i = 0; i < predecessor.size(); ++i) load(predecessor[i], word, position + i);
  for (const Match& match : context_matches_) load(*match.pattern, *context_word_, match.position);
  if (!production.before.empty()) machine_.run(production.before);
  return production.condition.empty() || machine_.run(production.condition) != 0;
}

bool Matcher::matches_left(const std::vector<ModulePattern>& context, std::size_t position) {
  const std::vector<Word::Module>& modules = context_word_->modules;
  for (std::size_t wanted = context.size(); wanted > 0;) {
    if (position == 0) return false;
    const Word::Module& module = modules[--position];
    if (module.symbol == ']') {
      if (partners_[position] == modules.size()) return false;
      position = partners_[position];
    } else if (module.symbol != '[' && !grammar_.ignored[static_cast<std::size_t>(module.symbol)]) {
      const ModulePattern& pattern = context[--wanted];
      if (!same(pattern, module)) return false;
      context_matches_.push_back({&pattern, position});
    }
  }
  return true;
}

bool Matcher::matches_right(const std::vector<ModulePattern>& context, std::size_t position) {
  const std::vector<Word::Module>& modules = context_word_->modules;
  for (std::size_t wanted = 0; wanted < context.size();) {
    const ModulePattern& pattern = context[wanted];
    if (pattern.symbol == '=') {  // pass over the rest of this branch
      position = end_of_branch(position);
      ++wanted;
      continue;
    }
    if (position >= modules.size()) return false;
    const Word::Module& module = modules[position];
    if (grammar_.ignored[static_cast<std::size_t>(module.symbol)]) {
      ++position;
    } else if (module.symbol == '[' && pattern.symbol != '[') {
      position = std::size_t{partners_[position]} + 1;
    } else {
      if (!same(pattern, module)) return false;
      context_matches_.push_back({&pattern, position});
      ++wanted;
      ++position;
    }
  }
  return true;
}

std::size_t Matcher::end_of_branch(std::size_t position) const {
  const std::vector<Word::Module>& modules = context_word_->modules;
  while (position < modules.size() && modules[position].symbol != ']') {
    position = modules[position].symbol == '[' ? std::size_t{partners_[position]} + 1 : position + 1;
  }
  return std::min(position, modules.size());
}

void Matcher::load(const ModulePattern& pattern, const Word& word, std::size_t position) {
  const std::span<const float> values = word.parameters_of(word.modules[position]);
  for (std::size_t i = 0; i < values.size(); ++i) machine_.state.slots[pattern.slots[i]] = values[i];
}

void append_modules(const std::vector<ModuleTemplate>& modules, Machine& machine, std::uint16_t birth_step,
                    Word& word) {
  for (const ModuleTemplate& module : modules) {
    word.modules.push_back({module.symbol, static_cast<std::uint8_t>(module.parameters.size()), birth_step,
                            static_cast<std::uint32_t>(word.parameters.size())});
    for (const Program& parameter : module.parameters) word.parameters.push_back(machine.run_parameter(parameter));
  }
}

void append_copy(const Word& from, std::size_t position, Word& word) {
  Word::Module module = from.modules[position];
  const std::span<const float> values = from.parameters_of(module);
  module.first_parameter = static_cast<std::uint32_t>(word.parameters.size());
  word.modules.push_back(module);
  word.parameters.insert(word.parameters.end(), values.begin(), values.end());
}

std::vector<std::uint32_t> bracket_partners(const Word& word) {
  const auto size = static_cast<std::uint32_t>(word.modules.size());
  std::vector<std::uint32_t> partners(size, 0);
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < size; ++i) {
    if (word.modules[i].symbol == '[') {
      partners[i] = size;
      open.push_back(i);
    } else if (word.modules[i].symbol == ']') {
      partners[i] = size;
      if (open.empty()) continue;
      partners[i] = open.back();
      partners[open.back()] = i;
      open.pop_back();
    }
  }
  return partners;
}

}  // namespace barkridge
