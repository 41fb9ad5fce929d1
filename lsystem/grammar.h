#pragma once
// The L-system as its author wrote it: the core of the cpfg language (docs/lsystem_language.md).

#include <map>
#include <memory>
#include <string>
#include <string_view>

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
/// Throws `InputError` with the place of the first mistake.
Grammar parse_grammar(std::string_view text, const std::string& file,
                      const std::map<std::string, std::string>& defines = {});

}  // namespace barkridge
