#pragma once

#include <functional>

#include "base/error.h"

namespace barkridge {

/// Told the fraction done, in [0, 1], by long jobs: from any thread, but never from two at once. Returns whether to go
/// on. An empty function means that nobody listens.
using Progress = std::function<bool(double fraction)>;

/// Reports, and throws `Cancelled` when the listener asks to stop.
inline void report(const Progress& progress, double fraction) {
  if (progress && !progress(fraction)) throw Cancelled();
}

}  // namespace barkridge
