#pragma once

#include <cstddef>

namespace barkridge {

/// Bytes of memory that this machine has in all.
std::size_t machine_memory();

}  // namespace barkridge
