#include "mesh/write.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>

#include "base/error.h"
#include "base/geometry.h"
#include "base/output_file.h"

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

void write_obj(const Mesh& mesh, const MeshWriteOptions& options, OutputFile& file) {
  file.write(comment_lines(options.comment, "# "));
  fmt::memory_buffer line;
  const auto put = [&] {
    file.write(line.data(), line.size());
    line.clear();
    return !file.failed();
  };
  for (const glm::vec3& p : mesh.positions) {
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("v {} {} {}\n"), p.x, p.y, p.z);
    if (!put()) return;
  }
  for (const glm::vec3& n : mesh.normals) {
    fmt::format_to(std::back_inserter(line), FMT_COMPILE("vn {} {} {}\n"), n.x, n.y, n.z);
    if (!put()) return;
  }
  for (const auto& triangle : mesh.triangles) {
    line.push_back('f');
    for (const std::uint64_t zero_based : triangle) {
      const std::uint64_t i = zero_based + 1;
      if (mesh.normals.empty()) {
        fmt::format_to(std::back_inserter(line), FMT_COMPILE(" {}"), i);
      } else {
        fmt::format_to(std::back_inserter(line), FMT_COMPILE(" {}//{}"), i, i);
      }
    }
    line.push_back('\n');
    if (!put()) return;
  }
}

void write_ply(const Mesh& mesh, const MeshWriteOptions& options, OutputFile& file) {
  const bool has_normals = !mesh.normals.empty();
  std::string header = "ply\nformat binary_little_endian 1.0\n" + comment_lines(options.comment, "comment ");
  header +=
      fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n", mesh.positions.size());
  if (has_normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  file.write(header);
  for (std::size_t i = 0; i < mesh.positions.size() && !file.failed(); ++i) {
    file.write(&mesh.positions[i], sizeof(glm::vec3));
    if (has_normals) file.write(&mesh.normals[i], sizeof(glm::vec3));
  }
  for (std::size_t i = 0; i < mesh.triangles.size() && !file.failed(); ++i) {
    std::array<char, 13> face{3};
    std::memcpy(face.data() + 1, mesh.triangles[i].data(), 12);
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
  throw InputError(
      fmt::format("{}: {}; meshes are written as .obj, .ply or .stl", path,
                  extension.empty() ? "the file name has no extension" : "unknown mesh format " + extension));
}

void write_mesh(const Mesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  assert(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
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
  }
  file.commit();
}

}  // namespace barkridge
