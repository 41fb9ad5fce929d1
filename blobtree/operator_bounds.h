#pragma once
// Bounds of an operator's field from those of its children. [docs/field.md, "Bounds"]

#include <span>
#include <vector>

#include "blobtree/field.h"
#include "blobtree/tree.h"

namespace barkridge {

/// Adds the bounds of one summand to those of a sum.
inline void add(FieldBounds& sum, const FieldBounds& summand) {
  sum.value.lo += summand.value.lo;
  sum.value.hi += summand.value.hi;
  sum.slope += summand.slope;
  sum.second.lo += summand.second.lo;
  sum.second.hi += summand.second.hi;
  sum.kink += summand.kink;
}

/// Those of F o w from those of F, with bounds of w as in WarpedBox: (F o w)'' is F'' along w' plus F' along w'', and
/// where w' jumps so does (F o w)', by F' along the jump.
FieldBounds through_warp(FieldBounds bounds, double stretch, double curvature, double jump);

/// Those of F (1 + amount n) from those of F and n.
FieldBounds displaced(const FieldBounds& field, double amount, const FieldBounds& noise);

FieldBounds bounds_of(const Sum&, std::span<const FieldBounds> children);
FieldBounds bounds_of(const Ricci& ricci, std::span<const FieldBounds> children);
FieldBounds bounds_of(const Union&, std::span<const FieldBounds> children);
FieldBounds bounds_of(const Intersection&, std::span<const FieldBounds> children);
FieldBounds bounds_of(const Difference&, std::span<const FieldBounds> children);
FieldBounds bounds_of(const Negative&, std::span<const FieldBounds> children);
FieldBounds bounds_of(const Contact& contact, std::span<const FieldBounds> children);

/// A box outside which a node's field is zero, from those of all earlier nodes.
Box support_of(const Node& node, std::span<const Box> supports);

/// That of every node.
std::vector<Box> supports_of(const BlobTree& tree);

}  // namespace barkridge
