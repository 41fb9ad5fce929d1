#pragma once
// The first point of a solid along a piece of a ray, found by bounds and not by hope.

#include <algorithm>
#include <array>
#include <optional>

#include "blobtree/field.h"

namespace barkridge {

/// The smallest t in a range with F >= kIsoValue, or none; with `any`, any such t. `sample(range, values)` gives F at
/// equal distances along a range, ends included. t is exact to `precision` where F bends no more upward than downward;
/// what is thinner than `tolerance` along the ray or exceeds the iso-value by no more than rounding may be missed,
/// nothing else.
///
/// Where F's bounds rule out that it reaches the iso-value between two samples, that is settled; elsewhere the piece
/// between them is sampled in turn, first pieces first. As the slope bounds F between samples to first order in their
/// distance and the second derivative to second order, two rounds are enough for most rays that do not graze.
/// [after Galin et al. 2020, "Segment Tracing Using Local Lipschitz Bounds"]
template <typename Real, typename Sample>
class RaySearch {
 public:
  static constexpr std::size_t kSamples = 16;  // a vector's worth a round
  using Samples = std::array<Real, kSamples>;

  RaySearch(const Sample& sample, const FieldBounds& bounds, double tolerance, double precision, bool any)
      : sample_(sample),
        slope_(bounds.slope),
        lowest_second_(bounds.second.lo),
        tolerance_(tolerance),
        precision_(precision),
        any_(any) {}

  std::optional<double> run(const Interval& range) const {
    constexpr Real kIso = static_cast<Real>(kIsoValue);
    Samples f;
    sample_(range, f);
    if (any_) {
      const std::size_t inside = first_above(f, kSamples);
      if (inside < kSamples) return at(range, inside);
    }
    const double h = (range.hi - range.lo) / kPieces;
    // How far the field can rise between two samples: above their mean, and above the larger of them.
    const double over_mean = 0.5 * slope_ * h, over_larger = -0.125 * lowest_second_ * h * h;
    const bool is_noise = std::min(over_mean, over_larger) < kNoise || h <= tolerance_;
    // At least what is reached in each piece.
    const auto mean_rise = static_cast<Real>(over_mean), larger_rise = static_cast<Real>(over_larger);
    Samples highest;
    for (std::size_t i = 0; i < kPieces; ++i) {
      const Real larger = std::max(f[i], f[i + 1]);
      highest[i] = std::max(std::min(Real{0.5} * (f[i] + f[i + 1]) + mean_rise, larger + larger_rise), larger);
    }
    highest[kPieces] = f[kPieces];
    for (std::size_t i = first_above(highest, kSamples); i < kPieces; ++i) {
      if (highest[i] < kIso) continue;
      if (f[i] >= kIso) return at(range, i);
      const auto crosses = [&](std::size_t piece) { return f[piece + 1] >= kIso; };
      if (!crosses(i) && is_noise) continue;
      if (crosses(i)) {
        const double rise = static_cast<double>(f[i + 1] - f[i]);
        if (is_noise || over_larger * h <= precision_ * rise) {
          return at(range, i) + h * (static_cast<double>(kIso - f[i]) / rise);
        }
      }
      // Neighbours that are not settled share a round.
      std::size_t last = i;
      while (!crosses(last) && last + 1 < std::min(kPieces, i + kMostTogether) && highest[last + 1] >= kIso) ++last;
      if (const std::optional<double> hit = run({at(range, i), at(range, last + 1)})) return hit;
      if (crosses(last)) return at(range, last + 1);  // by rounding only
      i = last;
    }
    if (f[kPieces] >= kIso) return range.hi;
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kPieces = kSamples - 1;
  static constexpr std::size_t kMostTogether = 5;  // so that every round tells three times more
  // Values in single precision may be off by as much: what could exceed the iso-value by less is not told from it.
  static constexpr double kNoise = 1e-6;

  static std::size_t first_above(const Samples& f, std::size_t none) {
    for (std::size_t i = 0; i < kSamples; ++i) {
      if (f[i] >= static_cast<Real>(kIsoValue)) return i;
    }
    return none;
  }

  static double at(const Interval& range, std::size_t i) {
    return range.lo + static_cast<double>(i) * ((range.hi - range.lo) / kPieces);
  }

  const Sample& sample_;
  double slope_;
  double lowest_second_;
  double tolerance_;
  double precision_;
  bool any_;
};

}  // namespace barkridge
