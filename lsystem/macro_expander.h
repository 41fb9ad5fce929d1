#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace barkridge {

struct Macro {
  bool takes_arguments = false;
  std::vector<std::string> parameters;
  std::string body;
  /// Set while its expansion is being read, in which its own name is left alone, as in C.
  bool active = false;
};
using MacroTable = std::map<std::string, Macro, std::less<>>;

/// Receives expanded text. `offset` is the place in the unexpanded text: of the byte itself, or of the macro's use.
struct ExpansionSink {
  std::function<void(char byte, std::size_t offset)> copied;
  std::function<void(std::string_view text, std::size_t offset)> expanded;
  /// Must throw.
  std::function<void(std::size_t offset, const std::string& message)> fail;
  /// Counts bytes produced, here or on the way; throws when they are too many.
  std::function<void(std::size_t bytes)> spend;
};

/// Replaces the macros in `text`, which holds no comments. Strings in double quotes are left alone. A blank is put
/// around each expansion, so that it cannot join its neighbours to another token.
void expand_macros(std::string_view text, MacroTable& macros, const ExpansionSink& sink, int nesting = 0);

/// The position after the string in double quotes that begins at `start`, or after the quote alone if the string does
/// not end on its line: then the quote is a module.
std::size_t end_of_quotes(std::string_view text, std::size_t start);

}  // namespace barkridge
