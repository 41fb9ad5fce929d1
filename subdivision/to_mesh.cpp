#include "subdivision/to_mesh.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace barkridge {

void keep_attributes(Mesh& mesh, std::vector<InternodeId> internodes, std::vector<float> ages) {
  if (!internodes.empty()) mesh.attributes.push_back({"internode", std::move(internodes)});
  if (!ages.empty()) mesh.attributes.push_back({"age", std::move(ages)});
}

Mesh to_mesh(ControlMesh mesh) {
  Mesh result;
  result.texture = std::move(mesh.texture);
  result.texture_triangles = std::move(mesh.texture_triangles);
  keep_attributes(result, std::move(mesh.internodes), std::move(mesh.ages));
  result.positions = std::move(mesh.positions);
  result.triangles = std::move(mesh.triangles);
  result.normals.assign(result.positions.size(), glm::vec3(0));
  for (const auto& [a, b, c] : result.triangles) {
    const glm::vec3& origin = result.positions[a];
    const glm::vec3 normal = glm::cross(result.positions[b] - origin, result.positions[c] - origin);
    for (const std::uint32_t v : {a, b, c}) result.normals[v] += normal;
  }
  tbb::parallel_for(std::size_t{0}, result.normals.size(), [&](std::size_t v) {
    const glm::dvec3 normal(result.normals[v]);  // squares of small areas are too small for floats
    const double length = glm::length(normal);
    result.normals[v] = length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
  });
  return result;
}

}  // namespace barkridge
