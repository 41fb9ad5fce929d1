#pragma once

#include "mesh/mesh.h"

namespace barkridge {

/// Removes closed pieces of the surface that enclose a hollow less than `size` across in every direction. At the bottom
/// of a crease, where the outside runs into a wedge of no width, single lattice points fall outside and look like
/// hollows of their own; real ones of that size cannot be told from them. Linear in the mesh, and keeps its order.
void fill_small_cavities(Mesh& mesh, double size);

}  // namespace barkridge
