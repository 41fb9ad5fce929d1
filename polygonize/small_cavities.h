#pragma once

#include "mesh/mesh.h"

namespace barkridge {

/// Removes closed pieces of the surface around hollows of less volume than half a cell for each unit of their area: slits less than
/// a cell wide, tubes of less than a cell's radius, bubbles of less than one and a half. At the bottom of a crease, where the outside runs into a
/// wedge of no width, lattice points fall outside and look like hollows of their own; real ones of that size cannot be
/// told from them. Linear in the mesh, and keeps its order.
void fill_small_cavities(Mesh& mesh, double cell_size);

}  // namespace barkridge
