#include "subdivision/control_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/error.h"

namespace barkridge {

namespace {

// A directed edge as one number.
std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }

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

using Edges = std::unordered_map<std::uint64_t, std::uint32_t>;

// The triangle on the left of every directed edge.
Edges directed_edges(const ControlMesh& mesh) {
  Edges edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
      if (from == to) throw InputError(fmt::format("triangle {} names vertex {} twice", t, from));
      if (!edges.emplace(edge_key(from, to), static_cast<std::uint32_t>(t)).second) {
        throw InputError(
            fmt::format("triangle {} runs along the edge from vertex {} to {}, as another does: the edge has more than "
                        "two triangles, "
                        "or two that disagree in orientation",
                        t, from, to));
      }
    }
  }
  return edges;
}

// Every vertex's triangles must be found by walking around it from any of them.
void check_fans(const ControlMesh& mesh, const Edges& edges) {
  std::vector<std::uint32_t> triangles_of(mesh.positions.size(), 0), first(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      ++triangles_of[vertex];
      first[vertex] = static_cast<std::uint32_t>(t);
    }
  }
  const auto corner_after = [&](std::uint32_t triangle, std::uint32_t vertex, int steps) {
    const auto& corners = mesh.triangles[triangle];
    return corners[(std::find(corners.begin(), corners.end(), vertex) - corners.begin() + steps) % 3];
  };
  for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    if (triangles_of[vertex] == 0) continue;
    std::uint32_t met = 0;
    // Against the clock until round or at a boundary, then from the start with the clock.
    std::uint32_t triangle = first[vertex];
    bool around = false;
    for (;;) {
      ++met;
      const auto next = edges.find(edge_key(vertex, corner_after(triangle, vertex, 2)));
      if (next == edges.end()) break;
      triangle = next->second;
      if (triangle == first[vertex]) {
        around = true;
        break;
      }
    }
    triangle = first[vertex];
    while (!around) {
      const auto next = edges.find(edge_key(corner_after(triangle, vertex, 1), vertex));
      if (next == edges.end()) break;
      triangle = next->second;
      ++met;
    }
    if (met != triangles_of[vertex])
      throw InputError(fmt::format("the triangles of vertex {} are not one fan", vertex));
  }
}

}  // namespace

void check(const ControlMesh& mesh) {
  check_finite(mesh.positions, "position");
  check_finite(mesh.texture, "texture coordinate");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    check_indices(mesh.triangles[t], mesh.positions.size(), "vertex", t);
  }
  check_size(mesh.texture_triangles.size(), mesh.triangles.size(), "triangles of texture");
  for (std::size_t t = 0; t < mesh.texture_triangles.size(); ++t) {
    check_indices(mesh.texture_triangles[t], mesh.texture.size(), "texture coordinate", t);
  }
  check_size(mesh.internodes.size(), mesh.positions.size(), "internodes of vertices");
  check_size(mesh.ages.size(), mesh.positions.size(), "ages of vertices");

  const Edges edges = directed_edges(mesh);
  check_fans(mesh, edges);
  for (std::size_t i = 0; i < mesh.sharp_edges.size(); ++i) {
    const auto [a, b] = mesh.sharp_edges[i].vertices;
    if (!edges.count(edge_key(a, b)) && !edges.count(edge_key(b, a))) {
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

}  // namespace barkridge
