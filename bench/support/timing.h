#pragma once
// Times that can be compared. A machine's speed drifts, so things that are set against each other take turns, and
// their ratio is taken turn by turn.

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace barkridge::bench {

using Clock = std::chrono::steady_clock;

inline double seconds_between(Clock::time_point start, Clock::time_point end) {
  return std::chrono::duration<double>(end - start).count();
}

class Stopwatch {
 public:
  double seconds() const { return seconds_between(start_, Clock::now()); }

 private:
  Clock::time_point start_ = Clock::now();
};

/// What one thing took, turn by turn.
struct Samples {
  std::vector<double> values;

  double median() const;
  double lowest() const;
  double highest() const;
};

/// The median of a's over b's, turn by turn. Both took part in the same turns.
double paired_ratio(const Samples& a, const Samples& b);

/// A thing to measure: does its work once and returns what it took.
using Measurement = std::function<double()>;

/// A turn of everything that does not count, then `turns` that do: A B C, A B C, ...
std::vector<Samples> take_turns(std::span<const Measurement> measurements, int turns);

/// Calls `work(0)` .. `work(threads - 1)` at once, each in a thread of its own, and returns the seconds from the first
/// one's start to the last one's end.
double seconds_on_threads(int threads, const std::function<void(std::size_t)>& work);

/// Calls `work` until that has taken this long, and returns the seconds of one call.
double seconds_per_call(double at_least, const std::function<void()>& work);

}  // namespace barkridge::bench
