#pragma once

#include <map>
#include <string>
#include <string_view>

#include "lsystem/notify.h"
#include "lsystem/source_text.h"

namespace barkridge {

/// Does to an L-system file what cpfg's preprocessor does: comments, `#define` with and without arguments, `#undef`,
/// `#include "file"` (relative to the including file), conditionals, line markers and continuation by backslash. A line
/// that begins with `#` and no directive's name is text, because `#` is a module.
///
/// `defines` replace the values of the text's own `#define`s; it is an error to name one that the text lacks.
/// Throws `InputError` at the first mistake and `LimitError` when includes or macros grow beyond 64 MB.
SourceText preprocess(std::string_view text, const std::string& file,
                      const std::map<std::string, std::string>& defines = {}, const Notify& listener = {});

}  // namespace barkridge
