#pragma once
// Measurements in processes of their own, so that each starts alike and its memory is its own.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/support/timing.h"

namespace barkridge::bench {

/// What a run measured, by name.
using Numbers = std::map<std::string, double>;

/// Runs this program again with `arguments` and returns the numbers that it prints. Throws `std::runtime_error` when it
/// fails.
Numbers run_self(const std::vector<std::string>& arguments);

/// One way to run this program, and the numbers that its runs printed.
struct ChildRuns {
  std::vector<std::string> arguments;
  std::map<std::string, Samples> numbers;

  double median(const std::string& name) const { return numbers.at(name).median(); }
};

/// The ways take turns. `done` is called after every run, with the way that ran.
void run_in_turns(std::vector<ChildRuns>& ways, int turns, const std::function<void(const ChildRuns&)>& done);

/// What such a process does: calls `work`, which returns numbers, "total" among them in seconds, and prints them. Short
/// work is repeated while warm, and the medians without the first are printed. Adds the "peak" of the memory, the
/// first call's.
void measure_in_child(const std::function<Numbers()>& work);

}  // namespace barkridge::bench
