#pragma once
// The L-system as its author wrote it: the core of the cpfg language (docs/lsystem_language.md).

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "lsystem/notify.h"

namespace barkridge {

struct GrammarDefinition;  // private to this room: lsystem/grammar_definition.h

/// A parsed and checked L-system: an immutable value, cheap to copy.
class Grammar {
 public:
  explicit Grammar(std::shared_ptr<const GrammarDefinition> definition) : definition_(std::move(definition)) {}
  const GrammarDefinition& definition() const { return *definition_; }

 private:
  std::shared_ptr<const GrammarDefinition> definition_;
};

/// Reads an L-system. `file` names the text in messages, and `#include` is relative to it. `defines` replace the values
/// of the text's own `#define`s of these names (it is an error to name one that the text does not define).
/// The listener hears of names that nobody defined and the like.
/// Throws `InputError` with the place of the first mistake, and of what the language has but this program not yet.
Grammar parse_grammar(std::string_view text, const std::string& file,
                      const std::map<std::string, std::string>& defines = {}, const Notify& listener = {});

}  // namespace barkridge
