#include "lsystem/growth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/large_room.h"

namespace barkridge {

namespace {

// What has just appeared has this part of its radius, because no radius may be 0.
constexpr double kLeastRadius = 1e-3;

// What stands on an internode's tip, in pipes: the exponent's powers of radii, of which a grown tip's is 1.
struct Load {
  double all = 0;
  double largest = 0;  // of one branch
};

void thicken_by_pipes(Skeleton& skeleton, double tip_radius, const GrowthOptions& options) {
  const double exponent = options.pipe.exponent;
  std::vector<Load> loads;
  resize_large(loads, skeleton.internodes.size());
  const auto carry = [&](InternodeId parent, double pipes) {
    if (parent == kNoInternode) return;
    Load& load = loads[static_cast<std::size_t>(parent)];
    load.all += pipes;
    load.largest = std::max(load.largest, pipes);
  };
  for (const ShedBranch& shed : skeleton.shed_branches) {
    carry(shed.parent, std::pow(shed.radius / tip_radius, exponent));
  }
  // Children before parents.
  for (std::size_t i = skeleton.internodes.size(); i-- > 0;) {
    Internode& internode = skeleton.internodes[i];
    const double own = std::pow(grown_part(internode.birth_step, options.thickening_steps, options), exponent);
    const double pipes = own * (1 - std::min(1.0, loads[i].largest)) + loads[i].all;
    internode.base_radius = internode.tip_radius = tip_radius * std::max(kLeastRadius, std::pow(pipes, 1 / exponent));
    carry(internode.parent, pipes);
  }
}

void thicken_by_age(Skeleton& skeleton, const GrowthOptions& options) {
  const auto part_of = [&](std::int32_t step) {
    return std::max(kLeastRadius, grown_part(step, options.thickening_steps, options));
  };
  const auto tip_step = [](const Internode& internode) { return internode.birth_step + 1; };
  std::vector<std::int32_t> tip_steps;
  resize_large(tip_steps, skeleton.internodes.size());
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    const Internode& internode = skeleton.internodes[i];
    tip_steps[i] = tip_step(internode);
    if (internode.parent == kNoInternode) continue;
    std::int32_t& carrier = tip_steps[static_cast<std::size_t>(internode.parent)];
    carrier = std::min(carrier, internode.birth_step);
  }
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    Internode& internode = skeleton.internodes[i];
    internode.base_radius *= part_of(internode.birth_step);
    internode.tip_radius *= part_of(std::max(tip_steps[i], internode.birth_step));
  }
}

}  // namespace

double birth_time(std::int32_t birth_step) { return birth_step - 1.0; }

double grown_part(std::int32_t birth_step, double steps, const GrowthOptions& options) {
  if (!options.time) return 1;
  const double age = *options.time - birth_time(birth_step);
  if (age >= steps) return 1;
  if (age <= 0) return 0;
  const double x = age / steps;
  return options.curve == GrowthCurve::kSigmoid ? x * x * (3 - 2 * x) : std::pow(x, options.exponent);
}

void thicken(Skeleton& skeleton, const GrowthOptions& options) {
  if (options.pipe.tip_radius) {
    thicken_by_pipes(skeleton, *options.pipe.tip_radius, options);
  } else if (options.time && options.thickening_steps > 0) {
    thicken_by_age(skeleton, options);
  }
}

}  // namespace barkridge
