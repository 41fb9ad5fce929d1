#pragma once
// Meshes as files for other programs. No format here states units or which way is up: coordinates are written as they
// are.

#include <string>

#include "mesh/mesh.h"

namespace barkridge {

enum class MeshFormat {
  obj,  ///< Wavefront OBJ: text, shortest decimals that read back to the same floats
  ply,  ///< PLY, binary little-endian
  stl,  ///< STL, binary: loose triangles, each with its own normal; no comment, no shared vertices
};

struct MeshWriteOptions {
  /// Put into the head of OBJ and PLY files, for instance the program's version and the scene's hash. May have
  /// several lines.
  std::string comment;
};

/// The format that a path's extension (.obj, .ply, .stl, in any case) stands for. Throws `InputError` for all others:
/// to be asked before the long work of making the mesh.
MeshFormat mesh_format(const std::string& path);

/// Writes the mesh in the format that the extension says, whole or not at all; the bytes depend on mesh and options
/// only. Throws `InputError` for unknown extensions, `LimitError` for what the format's 32-bit counts cannot hold,
/// `IoError`.
void write_mesh(const Mesh& mesh, const std::string& path, const MeshWriteOptions& options = {});

}  // namespace barkridge
