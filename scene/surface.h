#pragma once
// The ways to give a model a surface of triangles, side by side: polygonize its field, or dress its skeleton by a
// control mesh and refine that.

#include <cstddef>
#include <optional>

#include "base/progress.h"
#include "blobtree/field.h"
#include "mesh/mesh.h"
#include "scene/pipeline.h"
#include "subdivision/control_mesh.h"

namespace barkridge {

/// Whether the scene's surface is a control mesh's, and not its field's.
bool is_subdivided(const Scene& scene);

/// The control mesh that the scene's method makes of the skeleton. Throws `InputError` for a model without one, and
/// where the method cannot dress it.
ControlMesh make_control_mesh(const Scene& scene, const Skeleton& skeleton);

/// A control mesh refined as the scene says: all triangles alike or adaptively, with every vertex on the limit surface
/// and the surface's normals, or as a refined control mesh, perhaps with noise. Throws `LimitError` for more triangles
/// than the limit.
Mesh refine(const Scene& scene, const ControlMesh& control, std::size_t max_triangles);

/// The field's surface at the scene's cell size.
Mesh implicit_mesh(const Scene& scene, const Model& model, const Field& field, std::size_t max_triangles,
                   const Progress& progress = {});

}  // namespace barkridge
