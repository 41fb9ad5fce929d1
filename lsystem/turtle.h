#pragma once

#include <cstddef>

#include "base/progress.h"
#include "lsystem/grammar.h"
#include "lsystem/growth.h"
#include "lsystem/notify.h"
#include "lsystem/skeleton.h"
#include "lsystem/word.h"

namespace barkridge {

/// What a cpfg view file sets. Widths are diameters.
struct TurtleOptions {
  double angle_increment_degrees = 45;
  double step = 1;
  double line_width = 1;
  double line_width_increment = 0;
  double initial_scale = 1;
  double scale_multiplier = 1;
  int color = 128;
  int color_increment = 1;
  /// Whether `!` and `#` after a segment set its tip's width (cpfg's `tapered lines`).
  bool tapered_lines = true;
  /// At a time, sizes and turns are those of their modules' ages. What has less than a millionth of its length is not
  /// there yet.
  GrowthOptions growth;
  /// Most internodes a skeleton may have.
  std::size_t max_internodes = 20'000'000;
  /// Most modules that the homomorphism may make.
  std::size_t max_modules = 1'000'000'000;
  /// Most nested brackets.
  std::size_t max_bracket_depth = 2'000'000;
  Progress progress;
  /// Hears of commands that have no effect yet.
  Notify notify;
};

/// Draws a word as cpfg's turtle would, after the homomorphism of `grammar` if one is given. Start: origin, heading +y,
/// left -x.
///
/// A segment's parent is the last segment before it on its branch, or before the bracket that its branch begins with; a
/// move without drawing changes nothing about that, so that a gap may lie between a segment and its parent. A segment's
/// base has the width at its `F`, its tip the width at the next command that ends it: a tip of width 0 is drawn 1e-7
/// wide, as in cpfg. `@K` makes the last segment's tip a cut end, `@k` leaves a scar here, and both pass over the rest
/// of the branch; what stands beyond them already stays until `prune`. Segments of zero length are dropped and counted,
/// and their children belong to their parents.
///
/// Where the word keeps its cuts, each branch that was shed with a segment in it is recorded, as it was when it was
/// shed but where the plant now has its place.
///
/// `@W(width, swelling)` sets the ridge of the segments that follow on the branch and on those that leave it.
///
/// Throws `InputError` on positions and widths that are not finite, widths that are zero or negative where a segment
/// begins or negative where it ends, ridges out of range, and brackets without their partner; and `LimitError`.
Skeleton interpret(const Word& word, const Grammar* grammar = nullptr, const TurtleOptions& options = {});

}  // namespace barkridge
