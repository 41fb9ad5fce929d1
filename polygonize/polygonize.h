#pragma once

#include <cstddef>

#include "base/progress.h"
#include "blobtree/field.h"
#include "mesh/mesh.h"

namespace barkridge {

struct PolygonizeOptions {
    /// Edge length of the sampling cells, in scene units; > 0 and finite.
    double cell_size = 0;
    /// Most triangles; 0 means as many as indices allow.
    std::size_t max_triangles = 0;
    Progress progress;
};

/// The surface of the field's solid as a closed, oriented 2-manifold: marching cubes over those blocks of the lattice
/// (multiples of `cell_size` from the origin) that the field's bounds cannot rule out, so nothing is missed that the
/// lattice can see and empty space is never sampled. Vertices lie on lattice edges at roots of the field (not of its linear interpolation);
/// normals are the field's own. The result depends on field and options only, to the bit, not on threads.
/// Throws `InputError` for a cell size that is not positive or makes the lattice larger than 2^31 cells a side,
/// `LimitError` at the limit, `Cancelled`. Memory: in proportion to the output.
Mesh polygonize(const Field& field, const PolygonizeOptions& options);

}  // namespace barkridge
