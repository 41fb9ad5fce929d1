#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace barkridge {

/// A number for every vertex. The name is a word of letters, digits and underscores: files have it as it is.
struct MeshAttribute {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::int32_t>> values;
};

/// A triangle mesh with shared vertices. Triangles are counter-clockwise seen from outside.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< one a vertex, unit length; or none at all
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Texture coordinates; none at all, or what `texture_triangles` names: v runs up in the image, and both repeat with
  /// period 1.
  std::vector<glm::vec2> texture = {};
  /// For every corner of every triangle an index into `texture`, so that vertices on a seam have several coordinates
  /// without being several themselves. Empty: `texture` has one a vertex.
  std::vector<std::array<std::uint32_t, 3>> texture_triangles = {};
  std::vector<glm::vec3> colors = {};  ///< one a vertex, linear Rec. 709; or none at all
  std::vector<MeshAttribute> attributes = {};
};

}  // namespace barkridge
