#pragma once

#include "mesh/mesh.h"

namespace barkridge {

/// Removes closed pieces of the surface, around hollows or around bits of solid, that have less volume than 0.4 cells
/// for each unit of their area: bubbles of less than 1.2 cells' radius, tubes of less than 0.8. Along a crease the
/// outside runs into a wedge of no width, and lattice points in it look like pieces of their own; real ones of that
/// size cannot be told from them. The largest piece always stays. Linear in the mesh, and keeps its order.
void remove_unresolved_pieces(Mesh& mesh, double cell_size);

}  // namespace barkridge
