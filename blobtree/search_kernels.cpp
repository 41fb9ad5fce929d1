#include "blobtree/search_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "blobtree/search_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barkridge::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

SearchRound Settle(const float* f, float iso, float over_mean, float over_larger) {
  const hn::CappedTag<float, kSearchSamples> d;
  const auto least = hn::Set(d, iso), half = hn::Set(d, 0.5f), mean_rise = hn::Set(d, over_mean),
             larger_rise = hn::Set(d, over_larger);
  const auto bits = [&](auto mask, std::size_t i) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return (static_cast<unsigned>(bytes[0]) | static_cast<unsigned>(bytes[1]) << 8) << i;
  };
  SearchRound round;
  for (std::size_t i = 0; i < kSearchSamples; i += hn::Lanes(d)) {
    const auto a = hn::LoadU(d, f + i), b = hn::LoadU(d, f + i + 1), larger = hn::Max(a, b);
    const auto over_both = hn::Add(hn::Mul(half, hn::Add(a, b)), mean_rise);
    const auto highest = hn::Max(hn::Min(over_both, hn::Add(larger, larger_rise)), larger);
    round.inside |= bits(hn::Ge(a, least), i);
    round.open |= bits(hn::Ge(highest, least), i);
  }
  round.open &= (1u << (kSearchSamples - 1)) - 1;
  return round;
}

}  // namespace barkridge::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barkridge {

HWY_EXPORT(Settle);

SearchRound settle(const std::array<float, kSearchSamples>& f, float iso, float over_mean, float over_larger) {
  // One more, which has no piece after it.
  float padded[kSearchSamples + 1];
  std::copy(f.begin(), f.end(), padded);
  padded[kSearchSamples] = f.back();
  return HWY_DYNAMIC_DISPATCH(Settle)(padded, iso, over_mean, over_larger);
}

}  // namespace barkridge
#endif
