#pragma once
// The tree that all studies measure, of any size: deterministic, and botanical enough that its twigs crowd as twigs do.

#include <cstddef>

#include "lsystem/skeleton.h"

namespace barkridge::bench {

struct SampleTreeOptions {
  std::size_t internodes = 200;
  double trunk_radius = 0.025;
  /// Radii follow r^e = sum of the children's r^e. With 0 the exponent is what makes the thinnest twig this many times
  /// thinner than the trunk; 2 is da Vinci's plain rule.
  double exponent = 0;
  double thinness = 60;
};

struct SampleTree {
  Skeleton skeleton;
  std::size_t tips = 0;
  double exponent = 0;
  double thinnest_radius = 0;
};

/// A tree of exactly `internodes` tapered internodes, y up, from the origin, as high or wide as 1: a leading shoot with
/// one or two laterals at every node, the longest shoots growing first. Cost: N log N.
SampleTree sample_tree(const SampleTreeOptions& options);

double median_length(const Skeleton& skeleton);
Box bounding_box(const Skeleton& skeleton);

}  // namespace barkridge::bench
