#pragma once
// The list of turtle operations that TreeDraw's L-system compiler writes.

#include <string>
#include <string_view>

#include "lsystem/skeleton.h"

namespace barkridge {

/// Reads an LST file [Pie12, section 4.1.5]: a first line `LST 0.1`, then operations in any number of lines,
///
///     SB()                       remembers the state; EB() returns to the last one remembered
///     MovRel3f(x, y, z)          moves by a vector of the turtle's own frame
///     RotRel3f(angle, x, y, z)   turns by radians, counter-clockwise about an axis of the turtle's own frame
///     Cylinder(r0, r1, length)   an internode from here along the frame's y, which does not move the turtle
///
/// from the origin with the axes as frame. A cylinder's parent is the last one before it on its branch, or before the
/// bracket that its branch begins with; after a bracket begins the next order. Cylinders of zero length are dropped and
/// counted, their children belong to their parents. A base within rounding of its parent's tip is put there exactly.
///
/// Throws `InputError` with the place for another first line, unknown operations, wrong numbers of arguments, numbers
/// that are not finite, radii not above zero, negative lengths, an axis without direction, and brackets without their
/// partner; and `LimitError` for more internodes than a skeleton can have.
Skeleton read_lst(std::string_view text, const std::string& file);

}  // namespace barkridge
