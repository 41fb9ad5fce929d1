#include "mesh/write.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <glm/gtc/type_precision.hpp>
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

// The awkward mesh cut open along an edge in its texture, where one vertex has two coordinates, coloured and with
// attributes of both kinds.
Mesh dressed_mesh() {
  Mesh mesh = awkward_mesh();
  mesh.texture = {{0, 0}, {0.1f, 0.5f}, {1.0f / 3, 1}, {0.75f, -2}, {1, 0}};
  mesh.texture_triangles = {{0, 2, 1}, {4, 1, 3}, {4, 3, 2}, {1, 2, 3}};
  mesh.colors = {{0, 0, 0}, {1, 0.21404114f, 0}, {0.5f, 2, -1}, {0.002f, 0, 1}};  // 0.21404114 is sRGB's 0.5
  mesh.attributes = {{"deformation", std::vector<float>{0, -0.125f, 1e-20f, 3}},
                     {"internode", std::vector<std::int32_t>{7, -1, 16777217, 0}}};
  return mesh;
}

// Colours are read as the file has them.
Mesh read_obj(const std::string& text) {
  Mesh mesh;
  std::istringstream lines(text);
  const auto next = [](std::istream& words) {
    std::string word;
    REQUIRE(words >> word);
    return std::stof(word);
  };
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v" || key == "vn") {
      const float x = next(words), y = next(words), z = next(words);
      (key == "v" ? mesh.positions : mesh.normals).emplace_back(x, y, z);
      if (!(words >> std::ws).eof()) {
        const float red = next(words), green = next(words), blue = next(words);
        mesh.colors.emplace_back(red, green, blue);
      }
    } else if (key == "vt") {
      const float s = next(words), t = next(words);
      mesh.texture.emplace_back(s, t);
    } else if (key == "f") {
      std::array<std::uint32_t, 3> triangle{}, texture{};
      bool is_textured = false;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        std::string word;
        REQUIRE(words >> word);
        const std::size_t first = word.find('/'), second = word.rfind('/');
        if (second != first) REQUIRE(word.substr(0, first) == word.substr(second + 1));
        triangle[corner] = static_cast<std::uint32_t>(std::stoul(word)) - 1;
        is_textured = first != std::string::npos && second != first + 1;
        if (is_textured) texture[corner] = static_cast<std::uint32_t>(std::stoul(word.substr(first + 1))) - 1;
      }
      mesh.triangles.push_back(triangle);
      if (is_textured) mesh.texture_triangles.push_back(texture);
    } else {
      REQUIRE(key == "#");
    }
  }
  return mesh;
}

// Reads by the header's properties. Colours are the file's bytes; coordinates of faces are one a corner.
Mesh read_ply(std::string_view bytes, std::string& header) {
  const std::string_view end = "end_header\n";
  const std::size_t length = bytes.find(end) + end.size();
  header = bytes.substr(0, length);
  bytes.remove_prefix(length);
  std::istringstream lines(header.substr(0, length - end.size()));
  std::size_t vertices = 0, faces = 0;
  std::vector<std::pair<std::string, std::string>> properties;
  bool has_face_texture = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, type, name;
    words >> key >> type >> name;
    if (key == "element") (type == "vertex" ? vertices : faces) = std::stoul(name);
    if (key == "property" && type != "list") properties.emplace_back(type, name);
    has_face_texture = has_face_texture || line == "property list uchar float texcoord";
  }
  Mesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    for (const auto& [type, name] : properties) {
      if (name == "x") mesh.positions.push_back(take<glm::vec3>(bytes));
      if (name == "nx") mesh.normals.push_back(take<glm::vec3>(bytes));
      if (name == "s") mesh.texture.push_back(take<glm::vec2>(bytes));
      if (name == "red") mesh.colors.emplace_back(take<glm::u8vec3>(bytes));
      if (name == "deformation" || name == "internode") {
        const std::size_t at = name == "internode" ? 1 : 0;
        mesh.attributes.resize(std::max(mesh.attributes.size(), at + 1));
        if (i == 0 && at == 1) mesh.attributes[1] = {name, std::vector<std::int32_t>{}};
        if (i == 0 && at == 0) mesh.attributes[0] = {name, std::vector<float>{}};
        CHECK(type == (at == 1 ? "int" : "float"));
        std::visit(
            [&](auto& values) { values.push_back(take<typename std::decay_t<decltype(values)>::value_type>(bytes)); },
            mesh.attributes[at].values);
      }
    }
  }
  for (std::size_t i = 0; i < faces; ++i) {
    REQUIRE(take<unsigned char>(bytes) == 3);
    mesh.triangles.push_back(take<std::array<std::uint32_t, 3>>(bytes));
    if (!has_face_texture) continue;
    REQUIRE(take<unsigned char>(bytes) == 6);
    for (int corner = 0; corner < 3; ++corner) mesh.texture.push_back(take<glm::vec2>(bytes));
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

TEST_CASE("an OBJ file has texture coordinates a corner, and colours in sRGB") {
  const Mesh mesh = dressed_mesh();
  const Mesh back = read_obj(written(mesh, "a.obj"));
  CHECK(back.positions == mesh.positions);
  CHECK(back.normals == mesh.normals);
  CHECK(back.texture == mesh.texture);
  CHECK(back.texture_triangles == mesh.texture_triangles);
  REQUIRE(back.colors.size() == 4);
  CHECK(back.colors[0] == glm::vec3(0));
  CHECK(back.colors[1].y == Approx(0.5).margin(1e-6));
  CHECK(back.colors[2].x == Approx(0.7353570).margin(1e-6));
  CHECK(back.colors[2].y == 1);
  CHECK(back.colors[2].z == 0);
  CHECK(back.colors[3].x == Approx(0.02584).margin(1e-6));
}

TEST_CASE("an OBJ file of a mesh without seams names every vertex's own texture coordinates") {
  Mesh mesh = dressed_mesh();
  mesh.texture.resize(4);
  mesh.texture_triangles.clear();
  CHECK(read_obj(written(mesh, "a.obj")).texture_triangles == mesh.triangles);
  mesh.normals.clear();
  CHECK(read_obj(written(mesh, "a.obj")).texture_triangles == mesh.triangles);
}

TEST_CASE("a PLY file has colours and attributes of vertices, and texture coordinates of faces where there are seams") {
  Mesh mesh = dressed_mesh();
  std::string header;
  Mesh back = read_ply(written(mesh, "a.ply"), header);
  CHECK(back.positions == mesh.positions);
  CHECK(back.triangles == mesh.triangles);
  REQUIRE(back.colors.size() == 4);
  CHECK(back.colors[1] == glm::vec3(255, 128, 0));
  REQUIRE(back.attributes.size() == 2);
  for (std::size_t a = 0; a < 2; ++a) CHECK(back.attributes[a].values == mesh.attributes[a].values);
  REQUIRE(back.texture.size() == 12);
  for (std::size_t i = 0; i < 12; ++i) CHECK(back.texture[i] == mesh.texture[mesh.texture_triangles[i / 3][i % 3]]);

  mesh.texture.resize(4);
  mesh.texture_triangles.clear();
  back = read_ply(written(mesh, "a.ply"), header);
  CHECK(back.texture == mesh.texture);
  CHECK(header.find("property float s\nproperty float t\n") != std::string::npos);
}

TEST_CASE("an STL file of a dressed mesh is that of the bare one") {
  CHECK(written(dressed_mesh(), "a.stl") == written(awkward_mesh(), "a.stl"));
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
  CHECK_THROWS_WITH(mesh_format("tree.gltf"),
                    Catch::Contains(".gltf") && Catch::Contains(".obj, .ply, .stl, .inc or .pov"));
  CHECK_THROWS_AS(mesh_format("ply"), InputError);
  CHECK_THROWS_AS(write_mesh({}, "/tmp/a.txt"), InputError);
}

TEST_CASE("a full disk is reported and leaves the old mesh") {
  const ScratchFolder folder;
  Mesh mesh;
  mesh.positions.resize(200000, glm::vec3(1.0f / 3));
  mesh.triangles.resize(200000);
  for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.inc"}) {
    write_mesh({}, folder.path(name));
    const std::string before = read_file(folder.path(name));
    {
      const FileSizeLimit limit(1 << 16);
      CHECK_THROWS_AS(write_mesh(mesh, folder.path(name)), IoError);
    }
    CHECK(read_file(folder.path(name)) == before);
  }
  CHECK(folder.entries() == 4);
}
