#pragma once
// Noise that fills space. It has no seams around a branch, since that stands in it as in a block of wood.

#include <cstdint>

#include "bark/graded.h"

namespace barkridge {

/// Gradient noise about 0 with wavelengths from 1 to 2 in every direction: smooth to the second derivative, rarely
/// beyond +-0.7 and never beyond +-1.04. Its mean over much space is 0. [Perlin 2002, "Improving Noise"]
Graded gradient_noise(const Vec3& p, std::uint64_t seed);

/// The same with p stretched: noise of (p.x * scale.x, ..), graded by p.
Graded gradient_noise(const Vec3& p, const Vec3& scale, std::uint64_t seed);

/// `octaves` of it, each of twice the frequency and half the height of the last. Octaves that are finer than
/// `footprint`, the width of what one value stands for, fade out.
Graded layered_noise(const Vec3& p, const Vec3& scale, int octaves, double footprint, std::uint64_t seed);

/// How much of a detail of some width is left in the mean over a footprint: 1 where it is much wider, 0 where narrower.
double seen_share(double width, double footprint);

}  // namespace barkridge
