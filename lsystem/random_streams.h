#pragma once
// cpfg's random numbers, bit for bit. Unlike those of base/random.h they are a sequence with a state, because a model's
// text is written against that sequence.

#include <cstdint>

namespace barkridge {

/// The 48-bit linear congruential generator of C's `drand48` family.
class Drand48 {
 public:
  Drand48() = default;
  explicit Drand48(std::uint64_t state) : state_(state & kMask) {}
  /// The state that C's `srand48(seed)` sets; only the low 32 bits of `seed` matter.
  static Drand48 seeded(std::int64_t seed) {
    return Drand48(((static_cast<std::uint64_t>(seed) & 0xFFFFFFFFu) << 16) | 0x330E);
  }

  /// The next number, uniform in [0, 1).
  double next() {
    state_ = (0x5DEECE66Dull * state_ + 0xB) & kMask;
    return static_cast<double>(state_) * 0x1.0p-48;
  }

 private:
  static constexpr std::uint64_t kMask = (std::uint64_t{1} << 48) - 1;
  std::uint64_t state_ = 0;
};

/// The streams that an L-system draws from. A homomorphism with a seed of its own swaps `uniform` for its own
/// generator; the Gaussian numbers' spare one is common to both, as in cpfg.
struct RandomStreams {
  /// Behind `ran`, `nran`, `bran` and `biran`.
  Drand48 uniform = Drand48::seeded(0);
  /// Behind the choice among productions.
  Drand48 choice;
  /// The second number of a pair that the polar method makes. cpfg starts with one in store: before any `srand` the
  /// first `nran` gives the mean.
  double spare_normal = 0;
  bool has_spare_normal = true;

  /// `srand(seed)`.
  void seed_uniform(std::int64_t seed);
  /// `seed: n`. cpfg keeps 16 bits of it and ignores 0.
  void seed_choice(std::int64_t seed);

  /// A normal number by the polar method.
  double normal(double mean, double deviation);
  /// A number of the beta distribution. [Cheng 1978, algorithm BA]
  double beta(double a, double b);
  /// How many of `n` coins with probability `p` show heads.
  double binomial(int n, double p);
};

}  // namespace barkridge
