#pragma once

#include <functional>
#include <string>

namespace barkridge {

/// Told what a person may want to know but no program has to act on: warnings, and what an L-system's `printf` writes.
/// An empty function means that nobody listens.
using Notify = std::function<void(const std::string& message)>;

inline void notify(const Notify& listener, const std::string& message) {
  if (listener) listener(message);
}

}  // namespace barkridge
