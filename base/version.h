#pragma once

namespace barkridge {

/// The program's version, "major.minor.patch".
const char* version();

}  // namespace barkridge
