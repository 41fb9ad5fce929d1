#include "blobtree/operator_bounds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/large_room.h"
#include "blobtree/contact.h"
#include "blobtree/primitive_bounds.h"
#include "blobtree/warp.h"

namespace barkridge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Applies `f` to all lower and to all upper ends: exact for functions that rise with every child.
template <typename F>
Interval of_rising(std::span<const FieldBounds> children, double start, F f) {
  Interval range{start, start};
  for (const FieldBounds& child : children) {
    range.lo = f(range.lo, child.value.lo);
    range.hi = f(range.hi, child.value.hi);
  }
  return range;
}

// The largest slope among children that can be the one chosen, i.e. for which `possible` holds.
template <typename Possible>
double slope_of_choice(std::span<const FieldBounds> children, Possible possible) {
  double slope = 0;
  for (const FieldBounds& child : children) {
    if (possible(child)) slope = std::max(slope, child.slope);
  }
  return slope;
}

// Of numbers in two ranges. What is unbounded times nothing is nothing.
Interval product(const Interval& a, const Interval& b) {
  const auto times = [](double x, double y) { return x == 0 || y == 0 ? 0.0 : x * y; };
  const double corners[] = {times(a.lo, b.lo), times(a.lo, b.hi), times(a.hi, b.lo), times(a.hi, b.hi)};
  const auto [lo, hi] = std::minmax_element(std::begin(corners), std::end(corners));
  return {*lo, *hi};
}

double lowest_second(std::span<const FieldBounds> children) {
  double lowest = 0;
  for (const FieldBounds& child : children) lowest = std::min(lowest, child.second.lo);
  return lowest;
}

double largest_kink(std::span<const FieldBounds> children) {
  double kink = 0;
  for (const FieldBounds& child : children) kink = std::max(kink, child.kink);
  return kink;
}

}  // namespace

FieldBounds through_warp(FieldBounds bounds, double stretch, double curvature, double jump) {
  const double mixed = bounds.slope > 0 ? bounds.slope * curvature : 0;
  const double stretch2 = stretch * stretch;
  bounds.second = {std::min(0.0, stretch2 * bounds.second.lo) - mixed,
                   std::max(0.0, stretch2 * bounds.second.hi) + mixed};
  bounds.kink = stretch * bounds.kink + bounds.slope * jump;
  bounds.slope *= stretch;
  return bounds;
}

FieldBounds displaced(const FieldBounds& field, double amount, const FieldBounds& noise) {
  const Interval factor{1 + amount * noise.value.lo, 1 + amount * noise.value.hi};
  const double steepness = amount * noise.slope;
  FieldBounds result;
  result.value = product(field.value, factor);
  result.slope = field.slope * factor.hi + product({0, steepness}, {0, std::max(-field.value.lo, field.value.hi)}).hi;
  // F'' (1 + a n) + 2 a F' n' + a F n''
  const Interval bent = product(field.second, factor);
  const Interval by_noise = product(field.value, {amount * noise.second.lo, amount * noise.second.hi});
  const double mixed = 2 * product({0, field.slope}, {0, steepness}).hi;
  result.second = {bent.lo - mixed + by_noise.lo, bent.hi + mixed + by_noise.hi};
  result.kink = field.kink * factor.hi;
  return result;
}

FieldBounds bounds_of(const Sum&, std::span<const FieldBounds> children) {
  FieldBounds sum{{0, 0}, 0, {0, 0}};
  for (const FieldBounds& child : children) add(sum, child);
  return sum;
}

FieldBounds bounds_of(const Ricci& ricci, std::span<const FieldBounds> children) {
  const double n = ricci.exponent;
  // The gradient is a sum of the children's with weights (F_i / F)^(n - 1); by Hoelder's inequality its length is at
  // most the n-norm of theirs.
  FieldBounds powers;
  for (const FieldBounds& child : children) {
    powers.value.lo += std::pow(std::max(0.0, child.value.lo), n);
    powers.value.hi += std::pow(std::max(0.0, child.value.hi), n);
    powers.slope += std::pow(child.slope, n);
  }
  return {{std::pow(powers.value.lo, 1 / n), std::pow(powers.value.hi, 1 / n)}, std::pow(powers.slope, 1 / n)};
}

FieldBounds bounds_of(const Union&, std::span<const FieldBounds> children) {
  const Interval range = of_rising(children, -kInfinity, [](double a, double b) { return std::max(a, b); });
  FieldBounds result{range, slope_of_choice(children, [&](const FieldBounds& c) { return c.value.hi >= range.lo; })};
  result.second.lo = lowest_second(children);
  result.kink = largest_kink(children);
  return result;
}

FieldBounds bounds_of(const Intersection&, std::span<const FieldBounds> children) {
  const Interval range = of_rising(children, kInfinity, [](double a, double b) { return std::min(a, b); });
  FieldBounds result{range, slope_of_choice(children, [&](const FieldBounds& c) { return c.value.lo <= range.hi; })};
  result.second.hi = 0;
  for (const FieldBounds& child : children) result.second.hi = std::max(result.second.hi, child.second.hi);
  result.kink = largest_kink(children);
  return result;
}

FieldBounds bounds_of(const Difference&, std::span<const FieldBounds> children) {
  const FieldBounds& a = children.front();
  const FieldBounds b = bounds_of(Union{}, children.subspan(1));
  if (b.value.hi <= 0) return a;
  // The complement falls with B and rises with A, by at most 1 a unit of A's excess over 2T.
  const auto complement = [](double fa, double fb) {
    const double ramp = std::clamp(1.0 - fb / kIsoValue, 0.0, 1.0);
    return std::max(0.0, 2 * kIsoValue - fb) + ramp * std::max(0.0, fa - 2 * kIsoValue);
  };
  const double excess = std::max(0.0, a.value.hi - 2 * kIsoValue);
  const double complement_slope = b.slope * (1 + excess / kIsoValue) + (excess > 0 ? a.slope : 0.0);
  const Interval range{std::min(a.value.lo, complement(a.value.lo, std::max(0.0, b.value.hi))),
                       std::min(a.value.hi, complement(a.value.hi, std::max(0.0, b.value.lo)))};
  return {range, std::max(a.slope, complement_slope)};
}

FieldBounds bounds_of(const Negative&, std::span<const FieldBounds> children) {
  FieldBounds result = children.front();
  for (const FieldBounds& child : children.subspan(1)) {
    result.value.lo -= child.value.hi;
    result.value.hi -= child.value.lo;
    result.slope += child.slope;
    result.second.lo -= child.second.hi;
    result.second.hi -= child.second.lo;
    result.kink += child.kink;
  }
  return result;
}

FieldBounds bounds_of(const Contact& contact, std::span<const FieldBounds> children) {
  // What each child does to the others, and all of them together.
  struct Effect {
    double lowest_expansion = 0, highest_expansion = 0, compression = 0, slope = 0, second = 0, kink = 0;
  };
  // Of e(f) for a child's field f: e' f'' + e'' f'^2, in size.
  const double most_bent = most_bent_expansion(contact.shape);
  const auto second_of_effect = [&](const FieldBounds& child, const ContactRange& range) {
    if (range.steepest_effect == 0) return 0.0;
    return range.steepest_effect * std::max(-child.second.lo, child.second.hi) + most_bent * child.slope * child.slope;
  };
  const auto effect_of = [&](const FieldBounds& child) {
    const ContactRange range = contact_range(contact.shape, child.value);
    return Effect{range.lowest_expansion,
                  range.highest_expansion,
                  std::max(0.0, child.value.hi - kIsoValue),
                  range.steepest_effect * child.slope,
                  second_of_effect(child, range),
                  range.steepest_effect * child.kink};
  };
  Effect all;
  double highest_lo = -kInfinity;
  for (const FieldBounds& child : children) {
    const Effect effect = effect_of(child);
    all.lowest_expansion += effect.lowest_expansion;
    all.highest_expansion += effect.highest_expansion;
    all.compression += effect.compression;
    all.slope += effect.slope;
    all.second += effect.second;
    all.kink += effect.kink;
    highest_lo = std::max(highest_lo, child.value.lo);
  }
  // Any child that can be the highest may be the one that the others deform. Its own effect is taken off again, which
  // may leave rounding.
  constexpr double kRounding = 1e-14;
  const auto of_others = [](double sum, double own) { return std::max(0.0, sum - own); };
  FieldBounds result{{kInfinity, -kInfinity}, 0};
  result.second.lo = lowest_second(children) - all.second;
  result.kink = largest_kink(children) + all.kink;
  std::size_t candidates = 0;
  for (const FieldBounds& child : children) {
    if (child.value.hi < highest_lo) continue;
    ++candidates;
    const Effect own = effect_of(child);
    const double compression = of_others(all.compression, own.compression);
    const double pressed =
        compression > 0 ? std::max(std::min(highest_lo, kIsoValue), highest_lo - compression) : highest_lo;
    const Interval expansion{of_others(all.lowest_expansion, own.lowest_expansion),
                             of_others(all.highest_expansion, own.highest_expansion)};
    result.value.lo = std::min(result.value.lo, pressed + expansion.lo - kRounding * all.lowest_expansion);
    result.value.hi = std::max(result.value.hi, child.value.hi + expansion.hi + kRounding * all.highest_expansion);
    result.slope = std::max(result.slope, child.slope + of_others(all.slope, own.slope) + kRounding * all.slope);
    // Where it is pressed down to the iso-value there is a crease.
    result.second.hi = compression > 0 ? kInfinity : child.second.hi + all.second;
  }
  // And where another becomes the highest.
  if (candidates > 1) result.second.hi = kInfinity;
  return result;
}

Box support_of(const Node& node, std::span<const Box> supports) {
  return std::visit(
      [&](const auto& what) -> Box {
        using What = std::decay_t<decltype(what)>;
        if constexpr (requires { support_of(what); }) {
          return support_of(what);
        } else if constexpr (std::is_same_v<What, Difference>) {
          return supports[node.children.front()];
        } else if constexpr (std::is_same_v<What, Bend>) {
          const Box& child = supports[node.children.front()];
          return Warp(what, child).support(child);
        } else if constexpr (std::is_constructible_v<Warp, What>) {
          return Warp(what).support(supports[node.children.front()]);
        } else {
          // Of intersections, too: where a child is negative, so are they.
          Box all;
          for (const NodeId child : node.children) all = unite(all, supports[child]);
          return all;
        }
      },
      node.what);
}

std::vector<Box> supports_of(const BlobTree& tree) {
  std::vector<Box> supports;
  resize_large(supports, tree.nodes.size());
  tbb::parallel_for(std::size_t{0}, tree.nodes.size(), [&](std::size_t i) {
    if (tree.nodes[i].children.empty()) supports[i] = support_of(tree.nodes[i], supports);
  });
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (!tree.nodes[i].children.empty()) supports[i] = support_of(tree.nodes[i], supports);
  }
  return supports;
}

}  // namespace barkridge
