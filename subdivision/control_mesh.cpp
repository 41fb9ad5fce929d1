#include "subdivision/control_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "subdivision/half_edges.h"

namespace barkridge {

namespace {

template <class Indices>
void check_indices(const Indices& indices, std::size_t count, const char* what, std::size_t triangle) {
  for (const std::uint32_t index : indices) {
    if (index >= count) {
      throw InputError(fmt::format("triangle {} names {} {}, but there are only {}", triangle, what, index, count));
    }
  }
}

template <class Values>
void check_finite(const Values& values, const char* what) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (int axis = 0; axis < values[i].length(); ++axis) {
      if (!std::isfinite(values[i][axis])) throw InputError(fmt::format("{} {} is not finite", what, i));
    }
  }
}

void check_size(std::size_t size, std::size_t wanted, const char* what) {
  if (size != 0 && size != wanted) {
    throw InputError(fmt::format("expected {} {}, one for each, but there are {}", wanted, what, size));
  }
}

bool has_edge(const HalfEdges& mesh, std::uint32_t a, std::uint32_t b) {
  if (std::max(a, b) >= mesh.outgoing.size()) return false;
  bool found = false;
  around(mesh, a, [&](std::uint32_t, std::uint32_t neighbour) { found = found || neighbour == b; });
  return found;
}

void check_sharpness(const ControlMesh& mesh, const HalfEdges& half_edges) {
  for (std::size_t i = 0; i < mesh.sharp_edges.size(); ++i) {
    const auto [a, b] = mesh.sharp_edges[i].vertices;
    if (!has_edge(half_edges, a, b)) {
      throw InputError(fmt::format("sharp edge {}, from vertex {} to {}, is no edge of the mesh", i, a, b));
    }
    if (!(mesh.sharp_edges[i].sharpness > 0))
      throw InputError(fmt::format("sharp edge {} needs a sharpness above 0", i));
  }
  for (std::size_t i = 0; i < mesh.sharp_vertices.size(); ++i) {
    if (mesh.sharp_vertices[i].vertex >= mesh.positions.size()) {
      throw InputError(fmt::format("sharp vertex {} names vertex {}, but there are only {}", i,
                                   mesh.sharp_vertices[i].vertex, mesh.positions.size()));
    }
    if (!(mesh.sharp_vertices[i].sharpness > 0)) {
      throw InputError(fmt::format("sharp vertex {} needs a sharpness above 0", i));
    }
  }
}

}  // namespace

void check(const ControlMesh& mesh) { connect(mesh); }

HalfEdges connect(const ControlMesh& mesh) {
  check_finite(mesh.positions, "position");
  check_finite(mesh.texture, "texture coordinate");
  check_size(mesh.texture_triangles.size(), mesh.triangles.size(), "triangles of texture");
  for (std::size_t t = 0; t < mesh.texture_triangles.size(); ++t) {
    check_indices(mesh.texture_triangles[t], mesh.texture.size(), "texture coordinate", t);
  }
  check_size(mesh.internodes.size(), mesh.positions.size(), "internodes of vertices");
  check_size(mesh.ages.size(), mesh.positions.size(), "ages of vertices");
  HalfEdges result = half_edges(mesh.triangles, mesh.positions.size());
  check_sharpness(mesh, result);
  return result;
}

}  // namespace barkridge
