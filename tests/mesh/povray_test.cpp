#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>

#include "base/output_file.h"
#include "mesh/write.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

constexpr int kSize = 120;

bool has_povray() {
  const bool found = std::system("command -v povray > /dev/null") == 0;
  if (!found) WARN("povray is not installed: nothing was rendered");
  return found;
}

// What POV-Ray makes of a scene: its pixels' mean brightness, 0 to 255, row by row.
std::vector<int> rendered(const ScratchFolder& folder, const std::string& scene) {
  const std::string command = "cd '" + folder.path("") + "' && povray -D +FP +I" + scene + " +Opicture.ppm +W" +
                              std::to_string(kSize) + " +H" + std::to_string(kSize) + " > messages 2>&1";
  const int status = std::system(command.c_str());
  INFO(read_file(folder.path("messages")));
  REQUIRE(status == 0);
  std::string picture = read_file(folder.path("picture.ppm"));
  REQUIRE(picture.size() > static_cast<std::size_t>(3 * kSize * kSize));
  picture = picture.substr(picture.size() - 3 * kSize * kSize);
  std::vector<int> pixels;
  for (std::size_t i = 0; i < picture.size(); i += 3) {
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += static_cast<unsigned char>(picture[i + c]);
    pixels.push_back(sum / 3);
  }
  return pixels;
}

// The part of the pixels that are not the background, which the upper left corner shows.
double covered(const std::vector<int>& pixels) {
  double count = 0;
  for (const int pixel : pixels) count += pixel != pixels[0];
  return count / static_cast<double>(pixels.size());
}

// A unit ball by latitude and longitude, with normals.
Mesh ball() {
  constexpr std::uint32_t kRows = 64;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= kRows; ++i) {
    for (std::uint32_t j = 0; j < 2 * kRows; ++j) {
      const double a = std::numbers::pi * i / kRows, b = std::numbers::pi * j / kRows;
      mesh.positions.emplace_back(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
    }
  }
  mesh.normals = mesh.positions;
  for (std::uint32_t i = 0; i < kRows; ++i) {
    for (std::uint32_t j = 0; j < 2 * kRows; ++j) {
      const std::uint32_t a = i * 2 * kRows + j, b = i * 2 * kRows + (j + 1) % (2 * kRows);
      if (i > 0) mesh.triangles.push_back({a, b, a + 2 * kRows});
      if (i + 1 < kRows) mesh.triangles.push_back({b, b + 2 * kRows, a + 2 * kRows});
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("POV-Ray renders a scene that shows the whole mesh in the middle") {
  if (!has_povray()) return;
  const ScratchFolder folder;
  write_mesh(ball(), folder.path("ball.pov"), {"a ball\nof two lines"});
  const std::vector<int> pixels = rendered(folder, "ball.pov");
  CHECK(read_file(folder.path("messages")).find("Warning:") == std::string::npos);
  // The ball about the unit ball's box, of radius sqrt(3), is seen under 35 degrees, or very nearly.
  const double distance = std::sqrt(3.0) / std::sin(17.5 / 180 * std::numbers::pi);
  const double radius = std::tan(std::asin(1 / distance)) / std::tan(17.5 / 180 * std::numbers::pi);
  CHECK(covered(pixels) == Approx(std::numbers::pi * radius * radius / 4).epsilon(0.03));
}

TEST_CASE("POV-Ray shows a mesh from its front and not mirrored") {
  if (!has_povray()) return;
  const ScratchFolder folder;
  write_mesh({{{-1, 0, 0}, {1, -1, 0}, {1, 1, 0}}, {}, {{0, 1, 2}}}, folder.path("a.pov"));
  const std::vector<int> pixels = rendered(folder, "a.pov");
  int left = 0, right = 0;
  for (int i = 0; i < kSize * kSize; ++i) {
    if (pixels[i] != pixels[0]) ++(i % kSize < kSize / 2 ? left : right);
  }
  CHECK(left > 100);
  CHECK(right > 2 * left);  // a triangle's half at the edge has three times the area of that at the corner
}

TEST_CASE("POV-Ray finds the texture coordinates of an included mesh") {
  if (!has_povray()) return;
  const ScratchFolder folder;
  // A square of which every corner but one is shared; u runs from left to right.
  write_mesh({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
              {},
              {{0, 1, 2}, {0, 2, 3}},
              {{0, 0.5f}, {1, 0.5f}},
              {{0, 1, 1}, {0, 1, 0}}},
             folder.path("square.inc"));
  folder.write("scene.pov",
               "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#include \"square.inc\"\n"
               "camera { orthographic location -z * 5 look_at 0 right x * 2 up y * 2 }\n"
               "object { Barkridge_Mesh texture { uv_mapping pigment { gradient x color_map {\n"
               "[0.5 rgb 0] [0.5 rgb 1] } } finish { ambient 0 diffuse 0 emission 1 } } }\n");
  const std::vector<int> pixels = rendered(folder, "scene.pov");
  int wrong = 0;
  for (int i = 0; i < kSize * kSize; ++i) {
    const int column = i % kSize;
    if (std::abs(column - kSize / 2) > 1) wrong += pixels[i] != (column < kSize / 2 ? 0 : 255);
  }
  CHECK(wrong <= 2 * kSize);  // the square's own edges are the picture's
}

TEST_CASE("POV-Ray accepts an empty mesh") {
  if (!has_povray()) return;
  const ScratchFolder folder;
  write_mesh({}, folder.path("a.pov"));
  CHECK(covered(rendered(folder, "a.pov")) == 0);
}
