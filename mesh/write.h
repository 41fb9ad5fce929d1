#pragma once
// Meshes as files for other programs. No format here states units or which way is up: coordinates are written as they
// are.

#include <string>

#include "mesh/mesh.h"

namespace barkridge {

enum class MeshFormat {
  /// Wavefront OBJ: text, shortest decimals that read back to the same floats. Texture coordinates are `vt`, colours
  /// stand behind a vertex's coordinates, sRGB from 0 to 1; attributes are left out.
  obj,
  /// PLY, binary little-endian. Colours are 8-bit sRGB `red`, `green`, `blue`, attributes are properties of their own
  /// names. Texture coordinates are `s`, `t` of the vertex; with seams, a list `texcoord` of the face, six numbers, as
  /// MeshLab has it, so that the vertices stay shared.
  ply,
  /// STL, binary: loose triangles, each with its own normal, and nothing else.
  stl,
  /// POV-Ray include: declares `Barkridge_Mesh`, a mesh2 with normals and texture coordinates (mesh/povray.h); colours
  /// and attributes are left out.
  inc,
  /// POV-Ray scene: the same, and a camera that sees all of it, lights and a plain surface.
  pov,
};

struct MeshWriteOptions {
  /// Put into the head of OBJ and PLY files, for instance the program's version and the scene's hash. May have
  /// several lines.
  std::string comment;
};

/// The format that a path's extension (.obj, .ply, .stl, .inc, .pov, in any case) stands for. Throws `InputError` for
/// all others: to be asked before the long work of making the mesh.
MeshFormat mesh_format(const std::string& path);

/// Writes the mesh in the format that the extension says, whole or not at all; the bytes depend on mesh and options
/// only. Throws `InputError` for unknown extensions, `LimitError` for what the format's 32-bit counts cannot hold,
/// `IoError`.
void write_mesh(const Mesh& mesh, const std::string& path, const MeshWriteOptions& options = {});

}  // namespace barkridge
