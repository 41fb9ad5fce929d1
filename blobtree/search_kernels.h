#pragma once
// What the samples of a round of a search along a ray tell.

#include <algorithm>
#include <array>
#include <cstddef>

namespace barkridge {

inline constexpr std::size_t kSearchSamples = 16;  // a vector's worth a round

struct SearchRound {
  unsigned inside = 0;  ///< bit i: sample i is at least the iso-value
  unsigned open = 0;    ///< bit i: between samples i and i + 1, ends included, the field may be so
};

/// Between two samples the field rises by at most `over_mean` above their mean, and by at most `over_larger` above the
/// larger of them.
inline SearchRound settle(const std::array<double, kSearchSamples>& f, double iso, double over_mean,
                          double over_larger) {
  SearchRound round;
  for (std::size_t i = 0; i < kSearchSamples; ++i) round.inside |= unsigned{f[i] >= iso} << i;
  for (std::size_t i = 0; i + 1 < kSearchSamples; ++i) {
    const double larger = std::max(f[i], f[i + 1]);
    const double highest = std::max(std::min(0.5 * (f[i] + f[i + 1]) + over_mean, larger + over_larger), larger);
    round.open |= unsigned{highest >= iso} << i;
  }
  return round;
}

/// The same for the instruction set that the machine has.
SearchRound settle(const std::array<float, kSearchSamples>& f, float iso, float over_mean, float over_larger);

}  // namespace barkridge
