#pragma once
// The first point of a solid along a piece of a ray, found by bounds and not by hope.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "blobtree/field.h"
#include "blobtree/search_kernels.h"

namespace barkridge {

/// What a search is for.
enum class SearchAim {
  kAnyPoint,     ///< whether there is one
  kFirstPoint,   ///< exact to the tolerance
  kBeforeNewton  ///< good enough that one step of Newton's method makes it exact to the tolerance
};

/// What a search finds: the first point, or, before Newton, a place near it.
struct RayRoot {
  double t = 0;
  /// A step that is longer than this shows that the place was not that near.
  double longest_step = 0;
};

/// The smallest t in a range with F >= kIsoValue, or none. `sample(range, values)` gives F at equal distances along a
/// range, ends included. t is exact to `tolerance` where F bends no more upward than downward; what is thinner than
/// `tolerance` along the ray or exceeds the iso-value by no more than rounding may be missed, nothing else.
///
/// Where F's bounds rule out that it reaches the iso-value between two samples, that is settled; elsewhere the piece
/// between them is sampled in turn, first pieces first. As the slope bounds F between samples to first order in their
/// distance and the second derivative to second order, two rounds are enough for most rays that do not graze, and one
/// or two before Newton. [after Galin et al. 2020, "Segment Tracing Using Local Lipschitz Bounds"]
template <typename Real, typename Sample>
class RaySearch {
 public:
  using Samples = std::array<Real, kSearchSamples>;

  RaySearch(const Sample& sample, const FieldBounds& bounds, double tolerance, SearchAim aim)
      : sample_(sample),
        slope_(bounds.slope),
        lowest_second_(bounds.second.lo),
        largest_second_(std::max(-bounds.second.lo, bounds.second.hi)),
        kink_(bounds.kink),
        tolerance_(tolerance),
        aim_(aim) {}

  std::optional<RayRoot> run(const Interval& range) const {
    constexpr Real kIso = static_cast<Real>(kIsoValue);
    Samples f;
    sample_(range, f);
    const double h = (range.hi - range.lo) / kPieces;
    // How far the field can rise between two samples: above their mean, and above the larger of them.
    const double over_mean = 0.5 * slope_ * h, over_larger = h * (0.25 * kink_ - 0.125 * lowest_second_ * h);
    const bool is_noise = std::min(over_mean, over_larger) < kNoise || h <= tolerance_;
    const SearchRound round = settle(f, kIso, static_cast<Real>(over_mean), static_cast<Real>(over_larger));
    const auto is_inside = [&](std::size_t i) { return (round.inside >> i & 1) != 0; };
    const auto is_open = [&](std::size_t piece) { return (round.open >> piece & 1) != 0; };
    if (aim_ == SearchAim::kAnyPoint && round.inside != 0) {
      return root(range, static_cast<std::size_t>(std::countr_zero(round.inside)));
    }
    unsigned left = round.open;
    while (left != 0) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      if (is_inside(i)) return root(range, i);
      if (is_inside(i + 1)) {
        const double rise = static_cast<double>(f[i + 1] - f[i]);
        if (const std::optional<double> off = distance_to_root(rise, h, over_larger, is_noise)) {
          return RayRoot{at(range, i) + h * (static_cast<double>(kIso - f[i]) / rise), *off};
        }
      } else if (is_noise) {
        left &= left - 1;
        continue;
      }
      // Neighbours that are not settled share a round.
      std::size_t last = i;
      while (!is_inside(last + 1) && last + 1 < std::min(kPieces, i + kMostTogether) && is_open(last + 1)) ++last;
      if (const std::optional<RayRoot> hit = run({at(range, i), at(range, last + 1)})) return hit;
      if (is_inside(last + 1)) return root(range, last + 1);  // by rounding only
      left &= ~0u << (last + 1);
    }
    if (is_inside(kPieces)) return RayRoot{range.hi, longest_step()};
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kPieces = kSearchSamples - 1;
  static constexpr std::size_t kMostTogether = 5;  // so that every round tells three times more
  // Values in single precision may be off by as much: what could exceed the iso-value by less is not told from it.
  static constexpr double kNoise = 1e-6;
  // Before Newton, in units of the tolerance, where nothing bounds how the field bends up: how near the chord's root
  // must be if it bends up as it bends down, and how long a step shows that it does so much more.
  static constexpr double kCoarseness = 16;
  static constexpr double kLongestStep = 4 * kCoarseness;

  double longest_step() const { return aim_ == SearchAim::kBeforeNewton ? kLongestStep * tolerance_ : tolerance_; }

  // How far the root of a chord that rises by `rise` along `h` may be from the field's, if that is near enough.
  std::optional<double> distance_to_root(double rise, double h, double over_larger, bool is_noise) const {
    if (aim_ == SearchAim::kAnyPoint || is_noise) return longest_step();
    const double precision = aim_ == SearchAim::kBeforeNewton ? kCoarseness * tolerance_ : tolerance_;
    if (over_larger * h <= precision * rise) return longest_step();
    if (aim_ != SearchAim::kBeforeNewton || !std::isfinite(largest_second_)) return std::nullopt;
    // The chord is off the field by at most h (M h / 8 + K / 4), so its root by e = that over the least slope; Newton's
    // step leaves e (M e / 2 + K) over the least slope.
    const double least_slope = rise / h - largest_second_ * h - kink_;
    if (!(least_slope > 0)) return std::nullopt;
    const double off = h * (0.125 * largest_second_ * h + 0.25 * kink_) / least_slope;
    if (off * (0.5 * largest_second_ * off + kink_) > tolerance_ * least_slope) return std::nullopt;
    return std::max(2 * off, longest_step());
  }

  RayRoot root(const Interval& range, std::size_t i) const { return {at(range, i), longest_step()}; }

  static double at(const Interval& range, std::size_t i) {
    return range.lo + static_cast<double>(i) * ((range.hi - range.lo) / kPieces);
  }

  const Sample& sample_;
  double slope_;
  double lowest_second_, largest_second_, kink_;
  double tolerance_;
  SearchAim aim_;
};

}  // namespace barkridge
