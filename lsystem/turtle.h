#pragma once

#include <optional>

#include "lsystem/grammar.h"
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
    /// Most internodes a skeleton may have.
    std::size_t max_internodes = 20'000'000;
};

/// Draws a word as cpfg's turtle would, after the homomorphism of `grammar` if one is given. Start: origin, heading +y, left -x.
/// Throws `InputError` on values that are not finite and on widths that are not above zero where a segment is drawn, and
/// `LimitError`. Internodes of zero length are dropped and counted.
Skeleton interpret(const Word& word, const Grammar* grammar = nullptr, const TurtleOptions& options = {});

}  // namespace barkridge
