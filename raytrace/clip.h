#pragma once

#include "base/geometry.h"

namespace barkridge {

/// The part of `range` in which the ray is inside the closed box; empty when there is none. Boxes that share a face get
/// intervals that share an end, so no gap opens between them.
Interval clip(const Ray& ray, const Box& box, Interval range);

}  // namespace barkridge
