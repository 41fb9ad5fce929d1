#pragma once
// Noise that fills space. It has no seams around a branch, since that stands in it as in a block of wood.

#include <cstdint>

#include "base/graded.h"
#include "base/random.h"

namespace barkridge {

/// The hash's numbers, which vectors of it need by themselves.
inline constexpr std::uint32_t kLatticeFactors[3] = {0x8da6b343, 0xd8163841, 0xcb1ab31f};
inline constexpr std::uint32_t kFirstHashFactor = 0x7feb352d, kSecondHashFactor = 0x846ca68b;

/// Of a lattice corner, every bit as good as random. [the finalizer is C. Wellons' "lowbias32", 2018]
constexpr std::uint32_t lattice_hash(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) {
  std::uint32_t hash = seed + x * kLatticeFactors[0] + y * kLatticeFactors[1] + z * kLatticeFactors[2];
  hash = (hash ^ hash >> 16) * kFirstHashFactor;
  hash = (hash ^ hash >> 15) * kSecondHashFactor;
  return hash ^ hash >> 16;
}
constexpr std::uint32_t lattice_seed(std::uint64_t seed) { return static_cast<std::uint32_t>(mix_bits(seed) >> 32); }

/// The hash's two highest bits are the signs of the slope's two coordinates. Its lowest 16 tell which axis the slope is
/// across: z below the first of these numbers, y below the second, else x.
inline constexpr std::uint32_t kAcrossZ = 21846, kAcrossY = 43691;

/// No gradient noise is larger, has a longer slope or a larger second derivative along a line, whatever the corners'
/// slopes: the largest of sums over the corners of what one of them can add.
inline constexpr double kHighestNoise = 1.0364;
inline constexpr double kSteepestNoise = 3.7501;
inline constexpr double kMostBentNoise = 14.466;

/// Gradient noise about 0 with wavelengths from 1 to 2 in every direction: smooth to the second derivative, rarely
/// beyond +-0.7 and never beyond +-1.04. Its mean over much space is 0. [Perlin 2002, "Improving Noise"]
///
/// At the corners of the integer lattice, by its numbers modulo 2^32, it is zero with a slope towards the middle of one
/// of a cube's edges. A hash of 32 bits chooses which: vectors of them are quick on every instruction set.
Graded gradient_noise(const Vec3& p, std::uint64_t seed);

/// The same with p stretched: noise of (p.x * scale.x, ..), graded by p.
Graded gradient_noise(const Vec3& p, const Vec3& scale, std::uint64_t seed);

/// `octaves` of it, each of twice the frequency and half the height of the last. Octaves that are finer than
/// `footprint`, the width of what one value stands for, fade out.
Graded layered_noise(const Vec3& p, const Vec3& scale, int octaves, double footprint, std::uint64_t seed);

/// How much of a detail of some width is left in the mean over a footprint: 1 where it is much wider, 0 where narrower.
double seen_share(double width, double footprint);

}  // namespace barkridge
