#pragma once
// Random numbers as a function of what they are for. There is no state, so results do not depend on order or threads.

#include <cstdint>

namespace barkridge {

/// A 64-bit mix in which every input bit changes every output bit with probability close to 1/2.
/// [Steele, Lea, Flood 2014, SplitMix64's finalizer]
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Joins keys in order: `hash_keys(a, b)` differs from `hash_keys(b, a)`.
template <typename... Keys>
constexpr std::uint64_t hash_keys(Keys... keys) {
  std::uint64_t hash = 0;
  ((hash = mix_bits(hash ^ static_cast<std::uint64_t>(keys))), ...);
  return hash;
}

/// A number in [0, 1) that only the keys decide, uniformly distributed over keys.
template <typename... Keys>
constexpr double random_unit(Keys... keys) {
  return static_cast<double>(hash_keys(keys...) >> 11) * 0x1.0p-53;
}

}  // namespace barkridge
