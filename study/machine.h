#pragma once

#include <string>
#include <utility>
#include <vector>

namespace barkridge {

/// What times depend on, as names and texts: processor, cores, memory, compiler, the program's version and the commit
/// that it was built from ("unknown" outside of a clone).
std::vector<std::pair<std::string, std::string>> machine_facts();

/// The rest of the first line of `file` that starts with `key`, without blanks and colon before it; empty if there is
/// none.
std::string value_in(const char* file, const std::string& key);

}  // namespace barkridge
