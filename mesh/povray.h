#pragma once
// Meshes in the language of POV-Ray 3.7.

#include "base/output_file.h"
#include "mesh/mesh.h"

namespace barkridge {

/// Writes `#declare Barkridge_Mesh = mesh2 { ... }`: smooth where the mesh has normals, ready for `uv_mapping` where it
/// has texture coordinates. An empty mesh is declared as an empty union, since POV-Ray has no empty mesh2.
void write_povray_mesh(const Mesh& mesh, OutputFile& file);

/// Writes what makes a picture of `Barkridge_Mesh`: a camera that sees all of it from the front, with y up and in the
/// right-handed coordinates of the mesh, a sun, a sky, and a plain colour.
void write_povray_scene(const Mesh& mesh, OutputFile& file);

}  // namespace barkridge
