#include "mesh/povray.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/geometry.h"

namespace barkridge {

namespace {

// Writes `name { count, <...>, <...> }`, an element a line.
template <typename Elements, typename Format>
void write_list(const char* name, const Elements& elements, OutputFile& file, Format format) {
  file.write(fmt::format("  {} {{\n    {}", name, elements.size()));
  fmt::memory_buffer line;
  for (const auto& element : elements) {
    if (file.failed()) return;
    format(line, element);
    file.write(line.data(), line.size());
    line.clear();
  }
  file.write("\n  }\n");
}

void put_vector(fmt::memory_buffer& line, const glm::vec3& v) {
  fmt::format_to(std::back_inserter(line), FMT_COMPILE(",\n    <{},{},{}>"), v.x, v.y, v.z);
}
void put_uv(fmt::memory_buffer& line, const glm::vec2& v) {
  fmt::format_to(std::back_inserter(line), FMT_COMPILE(",\n    <{},{}>"), v.x, v.y);
}
void put_indices(fmt::memory_buffer& line, const std::array<std::uint32_t, 3>& t) {
  fmt::format_to(std::back_inserter(line), FMT_COMPILE(",\n    <{},{},{}>"), t[0], t[1], t[2]);
}

}  // namespace

void write_povray_mesh(const Mesh& mesh, OutputFile& file) {
  file.write("#version 3.7;\n");
  if (mesh.triangles.empty()) {
    file.write("#declare Barkridge_Mesh = union { }\n");
    return;
  }
  file.write("#declare Barkridge_Mesh = mesh2 {\n");
  write_list("vertex_vectors", mesh.positions, file, put_vector);
  if (!mesh.normals.empty()) write_list("normal_vectors", mesh.normals, file, put_vector);
  if (!mesh.texture.empty()) write_list("uv_vectors", mesh.texture, file, put_uv);
  write_list("face_indices", mesh.triangles, file, put_indices);
  if (!mesh.texture_triangles.empty()) write_list("uv_indices", mesh.texture_triangles, file, put_indices);
  file.write("}\n");
}

void write_povray_scene(const Mesh& mesh, OutputFile& file) {
  Box bounds;
  for (const glm::vec3& p : mesh.positions) bounds = unite(bounds, Vec3(p));
  const Vec3 middle = bounds.empty() ? Vec3(0) : bounds.center();
  // The ball about the box fills the 35 degrees of the picture's shorter side.
  const double distance = bounds.empty() ? 1 : 1.67 * bounds.diagonal();
  const Vec3 eye = middle + distance * glm::normalize(Vec3(-0.42, 0.14, 0.9));
  file.write(fmt::format(R"(
global_settings {{ assumed_gamma 1.0 }}
background {{ rgb <0.65, 0.75, 0.9> }}
#declare Barkridge_Side = 2 * tan(radians(17.5)) / min(image_width, image_height);
camera {{
  perspective
  location <{}, {}, {}>
  direction z
  right -x * Barkridge_Side * image_width
  up y * Barkridge_Side * image_height
  look_at <{}, {}, {}>
}}
light_source {{ <0.6, 0.7, 0.5> * {} + <{}, {}, {}> rgb 0.9 parallel point_at <{}, {}, {}> }}
object {{
  Barkridge_Mesh
  texture {{
    pigment {{ rgb <0.45, 0.36, 0.28> }}
    finish {{ ambient rgb <0.2, 0.22, 0.25> diffuse 0.8 }}
  }}
}}
)",
                         eye.x, eye.y, eye.z, middle.x, middle.y, middle.z, 10 * distance, middle.x, middle.y, middle.z,
                         middle.x, middle.y, middle.z));
}

}  // namespace barkridge
