#pragma once
// Plants of separate generalized cylinders: what other methods are compared with.

#include "subdivision/control_mesh.h"
#include "subdivision/stem_options.h"

namespace barkridge {

/// Dresses every axis of a skeleton, from a base to a tip through all joints along the children of its order, by a
/// generalized cylinder [Bloo90]: hexagonal cross-sections on parallel-transport frames at the ends of internodes. Axes
/// begin within the branch that carries them and are not joined to it; each is a piece of its own, a sphere or, with
/// open bases, a disc. Texture
/// coordinates v start at 0 at every axis' base.
///
/// Throws `InputError` for options out of range and for what `branches_of` refuses, and `LimitError` for more vertices
/// than can be numbered. Cost: linear.
ControlMesh cylinder_mesh(const Skeleton& skeleton, const StemOptions& options = {});

}  // namespace barkridge
