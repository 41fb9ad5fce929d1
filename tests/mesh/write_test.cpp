#include "mesh/write.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

// A tetrahedron with coordinates that few decimals cannot hold.
Mesh awkward_mesh() {
  return {{{0.1f, -1e-30f, 3}, {1.0f / 3, 0, -0.0f}, {16777216, 1, 2e10f}, {0, 0, 1.1920929e-7f}},
          {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0.6f, 0.8f, 0}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

template <typename T>
T take(std::string_view& bytes) {
  REQUIRE(bytes.size() >= sizeof(T));
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  bytes.remove_prefix(sizeof(T));
  return value;
}

Mesh read_obj(const std::string& text) {
  Mesh mesh;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v" || key == "vn") {
      std::string x, y, z;
      REQUIRE(words >> x >> y >> z);
      (key == "v" ? mesh.positions : mesh.normals).emplace_back(std::stof(x), std::stof(y), std::stof(z));
    } else if (key == "f") {
      std::array<std::uint32_t, 3> triangle{};
      for (auto& index : triangle) {
        std::string word;
        REQUIRE(words >> word);
        const std::size_t slashes = word.find("//");
        if (slashes != std::string::npos) REQUIRE(word.substr(0, slashes) == word.substr(slashes + 2));
        index = static_cast<std::uint32_t>(std::stoul(word)) - 1;
      }
      mesh.triangles.push_back(triangle);
    } else {
      REQUIRE(key == "#");
    }
  }
  return mesh;
}

Mesh read_ply(std::string_view bytes, std::string& header) {
  const std::string_view end = "end_header\n";
  const std::size_t length = bytes.find(end) + end.size();
  header = bytes.substr(0, length);
  bytes.remove_prefix(length);
  const auto count = [&](const std::string& element) {
    return std::stoul(header.substr(header.find("element " + element) + 9 + element.size()));
  };
  const bool has_normals = header.find("property float nx") != std::string::npos;
  Mesh mesh;
  for (std::size_t i = 0, n = count("vertex"); i < n; ++i) {
    mesh.positions.push_back(take<glm::vec3>(bytes));
    if (has_normals) mesh.normals.push_back(take<glm::vec3>(bytes));
  }
  for (std::size_t i = 0, n = count("face"); i < n; ++i) {
    REQUIRE(take<unsigned char>(bytes) == 3);
    mesh.triangles.push_back(take<std::array<std::uint32_t, 3>>(bytes));
  }
  CHECK(bytes.empty());
  return mesh;
}

std::string written(const Mesh& mesh, const std::string& name, const MeshWriteOptions& options = {}) {
  const ScratchFolder folder;
  write_mesh(mesh, folder.path(name), options);
  return read_file(folder.path(name));
}

}  // namespace

TEST_CASE("an OBJ file reads back to the same mesh") {
  const Mesh mesh = awkward_mesh();
  const Mesh back = read_obj(written(mesh, "a.obj", {"barkridge, scene 12ab"}));
  CHECK(back.positions == mesh.positions);
  CHECK(back.normals == mesh.normals);
  CHECK(back.triangles == mesh.triangles);
}

TEST_CASE("a PLY file reads back to the same mesh") {
  const Mesh mesh = awkward_mesh();
  std::string header;
  const Mesh back = read_ply(written(mesh, "a.ply", {"one\ntwo"}), header);
  CHECK(back.positions == mesh.positions);
  CHECK(back.normals == mesh.normals);
  CHECK(back.triangles == mesh.triangles);
  CHECK(header ==
        "ply\nformat binary_little_endian 1.0\ncomment one\ncomment two\nelement vertex 4\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n");
}

TEST_CASE("a mesh without normals is written without") {
  Mesh mesh = awkward_mesh();
  mesh.normals.clear();
  std::string header;
  CHECK(read_ply(written(mesh, "a.ply"), header).normals.empty());
  CHECK(read_obj(written(mesh, "a.obj")).triangles == mesh.triangles);
  CHECK(written(mesh, "a.obj").find("//") == std::string::npos);
}

TEST_CASE("an STL file has every triangle with its own normal") {
  const Mesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {1, 0, 0}}, {}, {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}}};
  const std::string content = written(mesh, "a.stl");
  CHECK(content.size() == 84 + 50 * 3);
  CHECK(content.substr(0, 5) != "solid");
  std::string_view bytes = std::string_view(content).substr(80);
  REQUIRE(take<std::uint32_t>(bytes) == 3);
  const std::array<glm::vec3, 3> normals{glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(0)};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(take<glm::vec3>(bytes) == normals[i]);
    for (const auto v : mesh.triangles[i]) CHECK(take<glm::vec3>(bytes) == mesh.positions[v]);
    CHECK(take<std::uint16_t>(bytes) == 0);
  }
}

TEST_CASE("an empty mesh makes a valid file") {
  std::string header;
  CHECK(read_ply(written({}, "a.ply"), header).positions.empty());
  CHECK(written({}, "a.stl").size() == 84);
  CHECK(written({}, "a.obj").empty());
}

TEST_CASE("a comment cannot break out of its lines") {
  const std::string text = written(awkward_mesh(), "a.obj", {"a\rv 1 2 3\n\nb\n"});
  CHECK(text.substr(0, 22) == "# a v 1 2 3\n# \n# b\nv 0");
}

TEST_CASE("the extension chooses the format, in any case") {
  CHECK(mesh_format("a/b.PLY") == MeshFormat::ply);
  CHECK(mesh_format("b.x.Obj") == MeshFormat::obj);
  CHECK(mesh_format("b.stl") == MeshFormat::stl);
  CHECK_THROWS_WITH(mesh_format("tree.gltf"), Catch::Contains(".gltf") && Catch::Contains(".obj, .ply or .stl"));
  CHECK_THROWS_AS(mesh_format("ply"), InputError);
  CHECK_THROWS_AS(write_mesh({}, "/tmp/a.txt"), InputError);
}

TEST_CASE("a full disk is reported and leaves the old mesh") {
  const ScratchFolder folder;
  Mesh mesh;
  mesh.positions.resize(200000, glm::vec3(1.0f / 3));
  mesh.triangles.resize(200000);
  for (const std::string name : {"a.obj", "a.ply", "a.stl"}) {
    write_mesh({}, folder.path(name));
    const std::string before = read_file(folder.path(name));
    {
      const FileSizeLimit limit(1 << 16);
      CHECK_THROWS_AS(write_mesh(mesh, folder.path(name)), IoError);
    }
    CHECK(read_file(folder.path(name)) == before);
  }
  CHECK(folder.entries() == 3);
}
