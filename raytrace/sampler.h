#pragma once
// The random numbers of a pixel: even within it, and spread between neighbours so that noise is fine-grained.

#include <array>
#include <cstdint>

#include <glm/vec2.hpp>

namespace barkridge {

/// What a pair of random numbers is for.
enum class Dimension { kPixel, kSun, kBounce, kLobe, kBounceSun, kCount };

/// What the samplers of all pixels of a picture share.
struct SampleLayout {
  std::uint64_t seed = 0;
  int pixel_digits = 0;   ///< base-4 digits of a pixel's number
  int sample_digits = 0;  ///< base-4 digits of a sample's number within its pixel

  SampleLayout(std::uint64_t seed, int full_width, int full_height, int samples_per_pixel);
};

/// The numbers of one pixel, as a function of seed, place in the full picture, sample and dimension. Samples are
/// numbered along a Z-order curve through the picture, the numbers shuffled in nested blocks of four, and mapped by
/// Owen-scrambled Sobol' pairs: so the samples of a pixel are stratified, its first 4, 16, 64 are so too, and those of
/// neighbours complement each other. [Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling
/// Error"]
/// Of one thread.
class PixelSampler {
 public:
  PixelSampler(const SampleLayout& layout, int x, int y);

  /// Two numbers in [0, 1).
  glm::dvec2 pair(int sample, Dimension dimension) const;

 private:
  std::uint64_t seed_;
  int pixel_digits_;
  int sample_digits_;
  std::uint64_t pixel_;  // its number along the curve
  // Made as they are asked for: a pixel in which nothing is hit needs but one.
  mutable std::array<std::uint64_t, static_cast<std::size_t>(Dimension::kCount)> shuffled_pixel_{};
};

}  // namespace barkridge
