#pragma once

#include <string_view>

#include "base/error.h"

namespace barkridge {

/// Whether the expression of an `#if` is not zero. It holds integers, C's operators but the bitwise ones, and names,
/// which are 0: macros have been expanded and `defined` replaced before. Throws `InputError` at `place`.
bool condition_holds(std::string_view expression, const SourceLocation& place);

}  // namespace barkridge
