#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace barkridge {

/// A triangle mesh with shared vertices. Triangles are counter-clockwise seen from outside.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< one a vertex, unit length; or none at all
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace barkridge
