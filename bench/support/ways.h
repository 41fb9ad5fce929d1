#pragma once
// Ways to model and look at a tree, each measured in processes of its own, so that all start alike and memory is their
// own; and tables that set them against each other.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/support/study.h"
#include "bench/support/timing.h"

namespace barkridge::bench {

/// What a run measured, by name.
using Numbers = std::map<std::string, double>;

struct Way {
  std::string model, surface;
  int threads = 1;
  /// With which this program does one run and prints its numbers.
  std::vector<std::string> arguments;
  /// What the runs printed. Empty if one failed.
  std::map<std::string, Samples> numbers;

  /// NaN, which tables leave out, without such a number.
  double median(const std::string& name) const;
};

/// Runs this program again and again, the ways taking turns, and says on stderr how it goes. A way that fails is given
/// up.
void run_in_turns(std::vector<Way>& ways, int turns);

/// What such a process does: calls `work`, which returns numbers, "total" among them in seconds, and prints them. Short
/// work is repeated while warm, and the medians without the first are printed. Adds the "peak" of the memory in bytes,
/// the first call's. Ends itself after `limit` seconds, or when it needs nearly all of the machine's memory.
void run_once(int limit, const std::function<Numbers()>& work);

/// Adds a table of ratios in the number called `name`, ridge to smooth and bend to ridge, turn by turn; and the largest
/// of them over models and threads as figures `prefix`_ridge_to_smooth and `prefix`_bend_to_ridge, NaN if one failed.
void add_surface_ratios(Study& study, const std::vector<Way>& ways, const std::string& name, const std::string& prefix);

}  // namespace barkridge::bench
