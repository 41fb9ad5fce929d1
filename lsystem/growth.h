#pragma once
// Growth over continuous time. Time counts derivation steps: what step s makes appears at time s - 1, with age 0, so
// that a word derived by n steps stands for the times after n - 1, up to n. What the axiom holds is one step old at
// time 0.

#include <cstdint>
#include <limits>
#include <optional>

#include "lsystem/skeleton.h"

namespace barkridge {

/// Words count the steps in which things were born up to this.
inline constexpr double kMaxGrowthTime = std::numeric_limits<std::uint16_t>::max();

/// How the size of what grows follows its age. Both go from 0 at age 0 to 1 at the full age, and have bounded slopes.
enum class GrowthCurve {
  kSigmoid,  ///< x^2 (3 - 2x): slow, fast, slow [PL90, section 6.2, the cubic growth function]
  kPower,    ///< x to a given exponent
};

/// Radii by the pipe model: where an internode ends, r^exponent is the sum of it over the internodes that it carries;
/// exponent 2 is da Vinci's rule.
struct PipeModel {
  double exponent = 2;  ///< at least 1
  /// Of a tip, in scene units, > 0. Without it radii are not the model's but those that are drawn.
  std::optional<double> tip_radius;
};

struct GrowthOptions {
  /// Without a time everything is grown up. From 0 to `kMaxGrowthTime`.
  std::optional<double> time;
  GrowthCurve curve = GrowthCurve::kSigmoid;
  double exponent = 1;  ///< of `kPower`; at least 1
  /// The ages at which lengths (and sizes of organs), turns (`+ - & ^`) and widths are full; 0 for at once.
  double elongation_steps = 1;
  double opening_steps = 0;
  double thickening_steps = 1;
  /// Each tip counts in it as far as it has thickened.
  PipeModel pipe;
  /// How long the scars of branches that `%` removes take to heal, > 0; without it they leave none.
  std::optional<double> healing_steps;
};

/// When something of this derivation step appeared.
double birth_time(std::int32_t birth_step);

/// The part of its size that something of this step has reached, of one that takes so many steps to be full: in [0, 1],
/// continuous in time.
double grown_part(std::int32_t birth_step, double steps, const GrowthOptions& options);

/// Gives a skeleton with drawn radii those of `options.time`. O(n).
///
/// By the pipe model, an internode begins one pipe, as thick as it has itself become: tip_radius * grown_part. The
/// thickest branch that begins to grow on it takes this pipe over with its own ones, up to the whole of it, so that
/// radii are continuous and never fall; the pipes of shed branches stay in what carried them. Without it, drawn radii
/// are multiplied by their grown part; a tip is as old as what can first stand on it: one step younger than its base,
/// or as old where an internode of the same step does. No radius becomes less than a thousandth of `tip_radius`, or of
/// the drawn one.
void thicken(Skeleton& skeleton, const GrowthOptions& options);

}  // namespace barkridge
