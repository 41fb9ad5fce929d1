#pragma once
// The noise of displacements, one point at a time, and what it can be around a point. [docs/field.md, "Displacement"]

#include <cstdint>

#include "base/graded.h"
#include "blobtree/field.h"
#include "blobtree/tree.h"

namespace barkridge {

/// What an octave is made of: `height` times the shape of gradient_noise(p * frequency + shift, seed). The heights of
/// all octaves add up to 1.
struct NoiseOctave {
  double height;
  Vec3 frequency, shift;
  std::uint64_t seed;
};
/// `number` counts from 0.
NoiseOctave octave_of(const SolidNoise& noise, int number);

/// The shapes of noise x: plain x / sqrt(x^2 + w^2), ridged 2 x^2 / (x^2 + w^2) - 1, with w these.
inline constexpr double kHillWidth = 0.5, kFissureWidth = 0.3;

/// Value and gradient, in double precision by the plain formulas.
Graded sample(const SolidNoise& noise, const Vec3& p);

/// Bounds within a distance from a point.
FieldBounds bounds_of(const SolidNoise& noise, const Vec3& center, double distance);

}  // namespace barkridge
