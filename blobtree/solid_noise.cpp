#include "blobtree/solid_noise.h"

#include <algorithm>
#include <cmath>

#include "base/noise.h"

namespace barkridge {

namespace {

// Values in single precision are off by less.
constexpr double kRounding = 1e-5;

// A shape, with its first two derivatives by x.
struct Shaped {
  double value, slope, second;
};

Shaped plain(double x) {
  constexpr double w2 = kHillWidth * kHillWidth;
  const double whole = x * x + w2, root = std::sqrt(whole);
  return {x / root, w2 / (whole * root), -3 * w2 * x / (whole * whole * root)};
}

Shaped ridged(double x) {
  constexpr double w2 = kFissureWidth * kFissureWidth;
  const double whole = x * x + w2;
  return {1 - 2 * w2 / whole, 4 * w2 * x / (whole * whole), 4 * w2 * (w2 - 3 * x * x) / (whole * whole * whole)};
}

// Where the derivatives of the shapes turn, for x >= 0, in units of the width.
constexpr double kPlainMostBent = 0.5;                   // the second derivative's extremum
constexpr double kRidgedSteepest = 0.57735026918962576;  // 1 / sqrt 3: the first's, where the second is 0

// What a shape and its derivatives are for x in a range.
struct ShapedRange {
  Interval value;
  double steepest;  // in size
  Interval second;
};

Interval around(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

ShapedRange plain(const Interval& x) {
  const Shaped lo = plain(x.lo), hi = plain(x.hi);
  ShapedRange range{{lo.value, hi.value}, std::max(lo.slope, hi.slope), around(lo.second, hi.second)};
  if (x.contains(0)) range.steepest = plain(0.0).slope;
  for (const double sign : {-1.0, 1.0}) {
    if (const double at = sign * kPlainMostBent * kHillWidth; x.contains(at)) {
      const double second = plain(at).second;
      range.second = {std::min(range.second.lo, second), std::max(range.second.hi, second)};
    }
  }
  return range;
}

ShapedRange ridged(const Interval& x) {
  const Shaped lo = ridged(x.lo), hi = ridged(x.hi);
  ShapedRange range{around(lo.value, hi.value), std::max(std::abs(lo.slope), std::abs(hi.slope)),
                    around(lo.second, hi.second)};
  const auto include = [&](double at) {
    if (!x.contains(at)) return;
    const Shaped there = ridged(at);
    range.value.lo = std::min(range.value.lo, there.value);
    range.steepest = std::max(range.steepest, std::abs(there.slope));
    range.second = {std::min(range.second.lo, there.second), std::max(range.second.hi, there.second)};
  };
  // At 0 the value is lowest and bends most; the second derivative is lowest where x is the width.
  for (const double at : {0.0, kRidgedSteepest, -kRidgedSteepest, 1.0, -1.0}) include(at * kFissureWidth);
  return range;
}

}  // namespace

NoiseOctave octave_of(const SolidNoise& noise, int number) {
  const double frequency = (1 << number) / noise.wavelength;
  NoiseOctave octave;
  // 4^-k, so that finer octaves are less steep, too.
  octave.height = 3.0 * (1 << 2 * (noise.octaves - 1 - number)) / ((1 << 2 * noise.octaves) - 1);
  octave.frequency = {frequency, frequency / noise.stretch, frequency};
  // So that the zeros at the corners of one lattice are none of the next one's.
  octave.shift = static_cast<double>(number) * Vec3(0.37, 0.61, 0.23);
  octave.seed = hash_keys(noise.seed, number);
  return octave;
}

Graded sample(const SolidNoise& noise, const Vec3& p) {
  Graded sum;
  for (int k = 0; k < noise.octaves; ++k) {
    const NoiseOctave octave = octave_of(noise, k);
    const Graded x = gradient_noise(p * octave.frequency + octave.shift, octave.seed);
    const Shaped shaped = noise.ridged ? ridged(x.value) : plain(x.value);
    sum = sum + Graded(octave.height) * Graded(shaped.value, shaped.slope * octave.frequency * x.slope);
  }
  return sum;
}

FieldBounds bounds_of(const SolidNoise& noise, const Vec3& center, double distance) {
  FieldBounds sum{{-kRounding, kRounding}, kRounding / noise.wavelength, {0, 0}};
  for (int k = 0; k < noise.octaves; ++k) {
    const NoiseOctave octave = octave_of(noise, k);
    // Along a line gradient noise changes the faster the higher its frequency there, and no faster than at the centre
    // but for how much it bends on the way.
    const double frequency = std::max(octave.frequency.x, octave.frequency.y);
    const double reach = frequency * distance;
    Interval values{-kHighestNoise, kHighestNoise};
    double steepest = kSteepestNoise;
    // Farther away noise can be anything, wherever it starts.
    if (kSteepestNoise * reach < kHighestNoise) {
      const Graded x = gradient_noise(center * octave.frequency + octave.shift, octave.seed);
      steepest = std::min(steepest, glm::length(x.slope) + kMostBentNoise * reach);
      values = {std::max(values.lo, x.value - steepest * reach), std::min(values.hi, x.value + steepest * reach)};
    }
    const ShapedRange range = noise.ridged ? ridged(values) : plain(values);
    sum.value.lo += octave.height * range.value.lo;
    sum.value.hi += octave.height * range.value.hi;
    const double slope = frequency * steepest;
    sum.slope += octave.height * range.steepest * slope;
    // s(x)'' = s'' x'^2 + s' x''
    const double turning = range.steepest * kMostBentNoise * frequency * frequency;
    sum.second.lo += octave.height * (std::min(0.0, range.second.lo) * slope * slope - turning);
    sum.second.hi += octave.height * (std::max(0.0, range.second.hi) * slope * slope + turning);
  }
  return sum;
}

}  // namespace barkridge
