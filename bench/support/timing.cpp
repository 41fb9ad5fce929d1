#include "bench/support/timing.h"

#include <algorithm>
#include <barrier>
#include <limits>
#include <thread>

namespace barkridge::bench {

double Samples::median() const {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

double Samples::lowest() const { return *std::min_element(values.begin(), values.end()); }
double Samples::highest() const { return *std::max_element(values.begin(), values.end()); }

double paired_ratio(const Samples& a, const Samples& b) {
  Samples ratios;
  for (std::size_t i = 0; i < std::min(a.values.size(), b.values.size()); ++i) {
    ratios.values.push_back(a.values[i] / b.values[i]);
  }
  return ratios.median();
}

std::vector<Samples> take_turns(std::span<const Measurement> measurements, int turns) {
  std::vector<Samples> samples(measurements.size());
  for (int turn = -1; turn < turns; ++turn) {
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const double value = measurements[i]();
      if (turn >= 0) samples[i].values.push_back(value);
    }
  }
  return samples;
}

double seconds_on_threads(int threads, const std::function<void(std::size_t)>& work) {
  const std::size_t count = static_cast<std::size_t>(threads);
  std::vector<Clock::time_point> starts(count), ends(count);
  {
    std::barrier together(threads);
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < count; ++i) {
      workers.emplace_back([&, i] {
        together.arrive_and_wait();
        starts[i] = Clock::now();
        work(i);
        ends[i] = Clock::now();
      });
    }
  }
  return seconds_between(*std::min_element(starts.begin(), starts.end()), *std::max_element(ends.begin(), ends.end()));
}

double seconds_per_call(double at_least, const std::function<void()>& work) {
  const Stopwatch all;
  for (std::size_t calls = 1;; calls *= 2) {
    const Stopwatch watch;
    for (std::size_t i = 0; i < calls; ++i) work();
    if (const double seconds = watch.seconds(); seconds >= at_least || all.seconds() >= 2 * at_least) {
      return seconds / static_cast<double>(calls);
    }
  }
}

}  // namespace barkridge::bench
