#pragma once
// Some triangles of a sheet as a sheet of its own.

#include <cstdint>
#include <vector>

#include "subdivision/sheet.h"

namespace barkridge {

/// `vertices` and `edges` are the numbers in the whole sheet of the part's vertices and edges, ascending, so that what
/// is sharp stays in front. A boundary of the part need not be one of the whole: there, values that a step or a limit
/// makes mean nothing. They are those of the whole wherever all triangles around a vertex, or both at an edge, are in
/// the part.
template <class Value>
struct SheetPart {
  Sheet<Value> sheet;
  std::vector<std::uint32_t> vertices, edges;
};

/// The part of the given triangles, which ascend. O(size of the whole).
template <class Value>
SheetPart<Value> part_of(const Sheet<Value>& whole, const std::vector<std::uint32_t>& triangles);

}  // namespace barkridge
