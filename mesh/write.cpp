#include "mesh/write.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "base/error.h"
#include "base/geometry.h"
#include "base/output_file.h"
#include "mesh/povray.h"

namespace barkridge {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY and STL are written as they lie in memory");

// The comment's lines, each behind `prefix`, without characters that could end a line.
std::string comment_lines(std::string_view comment, std::string_view prefix) {
  std::string text;
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    text += prefix;
    for (const char c : comment.substr(0, end)) text += std::iscntrl(static_cast<unsigned char>(c)) ? ' ' : c;
    text += '\n';
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  return text;
}

// From linear light to what files hold of colours, in [0, 1]. [IEC 61966-2-1]
glm::vec3 srgb(const glm::vec3& linear) {
  glm::vec3 encoded;
  for (int c = 0; c < 3; ++c) {
    const double x = std::clamp(static_cast<double>(linear[c]), 0.0, 1.0);
    encoded[c] = static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
  }
  return encoded;
}

const auto& texture_triangles(const Mesh& mesh) {
  return mesh.texture_triangles.empty() ? mesh.triangles : mesh.texture_triangles;
}

void write_obj(const Mesh& mesh, const MeshWriteOptions& options, OutputFile& file) {
  file.write(comment_lines(options.comment, "# "));
  fmt::memory_buffer line;
  const auto put = [&] {
    line.push_back('\n');
    file.write(line.data(), line.size());
    line.clear();
    return !file.failed();
  };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("v {} {} {}"), p.x, p.y, p.z);
    if (!mesh.colors.empty()) {
      const glm::vec3 color = srgb(mesh.colors[i]);
      fmt::format_to(std::back_inserter(line), FMT_COMPILE(" {} {} {}"), color.x, color.y, color.z);
    }
    if (!put()) return;
  }
  for (const glm::vec2& t : mesh.texture) {
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("vt {} {}"), t.x, t.y);
    if (!put()) return;
  }
  for (const glm::vec3& n : mesh.normals) {
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("vn {} {} {}"), n.x, n.y, n.z);
    if (!put()) return;
  }
  const auto index = [](std::uint32_t zero_based) { return std::uint64_t{zero_based} + 1; };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    line.push_back('f');
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint64_t v = index(mesh.triangles[i][corner]);
      fmt::format_to(std::back_inserter(line), FMT_COMPILE(" {}"), v);
      if (!mesh.texture.empty()) {
        fmt::format_to(std::back_inserter(line), FMT_COMPILE("/{}"), index(texture_triangles(mesh)[i][corner]));
      } else if (!mesh.normals.empty()) {
        line.push_back('/');
      }
      if (!mesh.normals.empty()) fmt::format_to(std::back_inserter(line), FMT_COMPILE("/{}"), v);
    }
    if (!put()) return;
  }
}

std::string ply_header(const Mesh& mesh, const std::string& comment) {
  std::string header = "ply\nformat binary_little_endian 1.0\n" + comment_lines(comment, "comment ");
  const auto properties = [&](const char* type, std::initializer_list<const char*> names) {
    for (const char* name : names) header += fmt::format("property {} {}\n", type, name);
  };
  header += fmt::format("element vertex {}\n", mesh.positions.size());
  properties("float", {"x", "y", "z"});
  if (!mesh.normals.empty()) properties("float", {"nx", "ny", "nz"});
  if (!mesh.texture.empty() && mesh.texture_triangles.empty()) properties("float", {"s", "t"});
  if (!mesh.colors.empty()) properties("uchar", {"red", "green", "blue"});
  for (const MeshAttribute& attribute : mesh.attributes) {
    const bool is_real = std::holds_alternative<std::vector<float>>(attribute.values);
    properties(is_real ? "float" : "int", {attribute.name.c_str()});
  }
  header += fmt::format("element face {}\n", mesh.triangles.size());
  properties("list uchar int", {"vertex_indices"});
  if (!mesh.texture_triangles.empty()) properties("list uchar float", {"texcoord"});
  return header + "end_header\n";
}

void write_ply_vertices(const Mesh& mesh, OutputFile& file) {
  for (std::size_t i = 0; i < mesh.positions.size() && !file.failed(); ++i) {
    file.write(&mesh.positions[i], sizeof(glm::vec3));
    if (!mesh.normals.empty()) file.write(&mesh.normals[i], sizeof(glm::vec3));
    if (!mesh.texture.empty() && mesh.texture_triangles.empty()) file.write(&mesh.texture[i], sizeof(glm::vec2));
    if (!mesh.colors.empty()) {
      const glm::vec3 color = srgb(mesh.colors[i]);
      std::array<std::uint8_t, 3> bytes{};
      for (int c = 0; c < 3; ++c) bytes[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(255 * color[c] + 0.5f);
      file.write(bytes.data(), bytes.size());
    }
    for (const MeshAttribute& attribute : mesh.attributes) {
      std::visit([&](const auto& values) { file.write(&values[i], sizeof values[i]); }, attribute.values);
    }
  }
}

void write_ply(const Mesh& mesh, const MeshWriteOptions& options, OutputFile& file) {
  file.write(ply_header(mesh, options.comment));
  write_ply_vertices(mesh, file);
  for (std::size_t i = 0; i < mesh.triangles.size() && !file.failed(); ++i) {
    std::array<char, 38> face{3};
    std::memcpy(face.data() + 1, mesh.triangles[i].data(), 12);
    if (mesh.texture_triangles.empty()) {
      file.write(face.data(), 13);
      continue;
    }
    face[13] = 6;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::memcpy(face.data() + 14 + 8 * corner, &mesh.texture[mesh.texture_triangles[i][corner]], 8);
    }
    file.write(face.data(), face.size());
  }
}

void write_stl(const Mesh& mesh, OutputFile& file) {
  // A header that began with "solid" would be taken for STL's text form.
  std::array<char, 80> header{};
  constexpr std::string_view kTitle = "binary STL";
  std::copy(kTitle.begin(), kTitle.end(), header.begin());
  file.write(header.data(), header.size());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  file.write(&count, sizeof count);
  for (const auto& t : mesh.triangles) {
    const std::array<glm::vec3, 3> corners{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    const Vec3 cross = glm::cross(Vec3(corners[1]) - Vec3(corners[0]), Vec3(corners[2]) - Vec3(corners[0]));
    const double length = glm::length(cross);
    const glm::vec3 normal(length > 0 ? cross / length : Vec3(0));
    std::array<char, 50> facet{};  // normal, three corners, two bytes of attributes that nobody uses
    std::memcpy(facet.data(), &normal, 12);
    std::memcpy(facet.data() + 12, corners.data(), 36);
    file.write(facet.data(), facet.size());
    if (file.failed()) return;
  }
}

// What the mesh's contract says about sizes.
[[maybe_unused]] bool is_consistent(const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  const auto fits = [](std::size_t size, std::size_t wanted) { return size == 0 || size == wanted; };
  return fits(mesh.normals.size(), vertices) && fits(mesh.colors.size(), vertices) &&
         fits(mesh.texture_triangles.size(), mesh.triangles.size()) &&
         (!mesh.texture_triangles.empty() || fits(mesh.texture.size(), vertices)) &&
         std::all_of(mesh.attributes.begin(), mesh.attributes.end(), [&](const MeshAttribute& attribute) {
           return std::visit([&](const auto& values) { return values.size() == vertices; }, attribute.values);
         });
}

void check_counts(const Mesh& mesh, MeshFormat format) {
  const bool signed_indices = format == MeshFormat::ply;
  if (signed_indices && mesh.positions.size() > std::size_t{std::numeric_limits<std::int32_t>::max()}) {
    throw LimitError("a PLY file can hold at most 2147483647 vertices; use a larger cell size");
  }
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw LimitError("a mesh file can hold at most 4294967295 triangles; use a larger cell size");
  }
}

}  // namespace

MeshFormat mesh_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".inc") return MeshFormat::inc;
  if (extension == ".pov") return MeshFormat::pov;
  throw InputError(
      fmt::format("{}: {}; meshes are written as .obj, .ply, .stl, .inc or .pov", path,
                  extension.empty() ? "the file name has no extension" : "unknown mesh format " + extension));
}

void write_mesh(const Mesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  assert(is_consistent(mesh));
  const MeshFormat format = mesh_format(path);
  check_counts(mesh, format);
  OutputFile file(path);
  switch (format) {
    case MeshFormat::obj:
      write_obj(mesh, options, file);
      break;
    case MeshFormat::ply:
      write_ply(mesh, options, file);
      break;
    case MeshFormat::stl:
      write_stl(mesh, file);
      break;
    case MeshFormat::inc:
    case MeshFormat::pov:
      file.write(comment_lines(options.comment, "// "));
      write_povray_mesh(mesh, file);
      if (format == MeshFormat::pov) write_povray_scene(mesh, file);
      break;
  }
  file.commit();
}

}  // namespace barkridge
