#include "raytrace/sampler.h"

#include <algorithm>
#include <bit>

#include "base/random.h"

namespace barkridge {

namespace {

int base_four_digits(std::uint64_t count) { return (std::bit_width(count - 1) + 1) / 2; }

// Puts a zero in front of every bit.
std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 16) & 0x0000ffff0000ffffull;
  v = (v | v << 8) & 0x00ff00ff00ff00ffull;
  v = (v | v << 4) & 0x0f0f0f0f0f0f0f0full;
  v = (v | v << 2) & 0x3333333333333333ull;
  return (v | v << 1) & 0x5555555555555555ull;
}

// One of the 24 permutations of four digits. As pairs of bits they are the maps x -> M x + b over two elements: six
// invertible M, given by the images of 1 and 2, and four b.
std::uint64_t permuted_digit(std::uint64_t digit, std::uint64_t hash) {
  constexpr std::uint64_t kImages[6][2] = {{1, 2}, {2, 1}, {1, 3}, {3, 1}, {2, 3}, {3, 2}};
  const auto& images = kImages[(hash >> 32) % 6];
  std::uint64_t result = hash & 3;
  if (digit & 1) result ^= images[0];
  if (digit & 2) result ^= images[1];
  return result;
}

// Appends the lowest `count` digits of `number` to `prefix`, each permuted as all digits above it decide. `seed` is
// well mixed.
std::uint64_t append_shuffled(std::uint64_t prefix, std::uint64_t number, int count, std::uint64_t seed) {
  for (int i = count - 1; i >= 0; --i) {
    const std::uint64_t digit = (number >> (2 * i)) & 3;
    prefix = prefix << 2 | permuted_digit(digit, mix_bits(seed ^ prefix));
  }
  return prefix;
}

std::uint32_t reverse_bits(std::uint32_t v) {
  v = (v & 0x55555555u) << 1 | (v >> 1 & 0x55555555u);
  v = (v & 0x33333333u) << 2 | (v >> 2 & 0x33333333u);
  v = (v & 0x0f0f0f0fu) << 4 | (v >> 4 & 0x0f0f0f0fu);
  return __builtin_bswap32(v);
}

// Sobol's first two dimensions, as 32-bit fractions: bit reversal, and Pascal's triangle modulo 2.
std::uint32_t sobol_first(std::uint64_t index) { return reverse_bits(static_cast<std::uint32_t>(index)); }

std::uint32_t sobol_second(std::uint64_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1) {
    if (index & 1) result ^= direction;
  }
  return result;
}

// Owen's scrambling by a hash in which every bit depends on those above it only.
// [Burley 2020, "Practical Hash-based Owen Scrambling"; constants by Vegdahl]
std::uint32_t owen_scrambled(std::uint32_t v, std::uint32_t seed) {
  v = reverse_bits(v);
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= seed >> 16 | 1;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return reverse_bits(v);
}

}  // namespace

SampleLayout::SampleLayout(std::uint64_t seed_key, int full_width, int full_height, int samples_per_pixel)
    : seed(seed_key),
      pixel_digits(std::bit_width(static_cast<unsigned>(std::max(full_width, full_height) - 1))),
      sample_digits(base_four_digits(static_cast<std::uint64_t>(samples_per_pixel))) {}

PixelSampler::PixelSampler(const SampleLayout& layout, int x, int y)
    : seed_(layout.seed),
      pixel_digits_(layout.pixel_digits),
      sample_digits_(layout.sample_digits),
      pixel_(spread_bits(static_cast<std::uint64_t>(x)) | spread_bits(static_cast<std::uint64_t>(y)) << 1) {}

glm::dvec2 PixelSampler::pair(int sample, Dimension dimension) const {
  const auto d = static_cast<std::size_t>(dimension);
  std::uint64_t& shuffled_pixel = shuffled_pixel_[d];
  // A leading 1 keeps prefixes of different lengths apart, and from 0, which stands for one not yet needed.
  if (shuffled_pixel == 0) shuffled_pixel = append_shuffled(1, pixel_, pixel_digits_, hash_keys(seed_, d, 0));
  const std::uint64_t index =
      append_shuffled(shuffled_pixel, static_cast<std::uint64_t>(sample), sample_digits_, hash_keys(seed_, d, 1));
  const std::uint64_t scramble = hash_keys(seed_, d, 2);
  const std::uint32_t u = owen_scrambled(sobol_first(index), static_cast<std::uint32_t>(scramble));
  const std::uint32_t v = owen_scrambled(sobol_second(index), static_cast<std::uint32_t>(scramble >> 32));
  return {u * 0x1p-32, v * 0x1p-32};
}

}  // namespace barkridge
