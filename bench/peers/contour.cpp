// How fast is a grid contoured that somebody else has filled? For contour.py: samples a tree, writes the grid, and runs
// polygonize and, if it is there, OpenVDB's volumeToMesh by turns on the same cells. Prints the numbers as JSON.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "bench/support/sample_tree.h"
#include "bench/support/surfaces.h"
#include "bench/support/timing.h"
#include "polygonize/polygonize.h"

#ifdef BARKRIDGE_BENCH_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>
#endif

namespace barkridge::bench {

namespace {

struct Options {
  int side = 256;
  int threads = 1;
  int turns = 5;
  std::string write;
};

// Values at the points of a cubic lattice, x fastest.
struct Grid {
  int side;
  double cell;
  Vec3 origin;
  std::vector<float> values;
};

constexpr int kBlock = 16;

// The points of a block, from its first index on.
void sample_block(const Field& field, const glm::ivec3& first, Grid& grid) {
  const auto place = [&](const glm::ivec3& index) { return grid.origin + grid.cell * Vec3(index); };
  const glm::ivec3 end = glm::min(first + kBlock, glm::ivec3(grid.side));
  const std::shared_ptr<const Field> part = field.restricted({place(first), place(end)});
  if (part->primitive_count() == 0) return;
  std::vector<Vec3> points;
  for (int z = first.z; z < end.z; ++z) {
    for (int y = first.y; y < end.y; ++y) {
      for (int x = first.x; x < end.x; ++x) points.push_back(place({x, y, z}));
    }
  }
  std::vector<double> values(points.size());
  part->values(points, values);
  std::size_t next = 0;
  for (int z = first.z; z < end.z; ++z) {
    for (int y = first.y; y < end.y; ++y) {
      float* row = &grid.values[(static_cast<std::size_t>(z) * static_cast<std::size_t>(grid.side) +
                                 static_cast<std::size_t>(y)) *
                                static_cast<std::size_t>(grid.side)];
      for (int x = first.x; x < end.x; ++x) row[x] = static_cast<float>(values[next++]);
    }
  }
}

// The tree fills a cube of about 1.05; the lattice is that of `polygonize`.
Grid sampled(const Field& field, int side) {
  Grid grid{side, 1.05 / (side - 1), Vec3(0), {}};
  grid.origin = grid.cell * glm::floor(Vec3(-0.51, -0.03, -0.51) / grid.cell);
  const std::size_t n = static_cast<std::size_t>(side);
  grid.values.assign(n * n * n, 0.0f);
  for (int z = 0; z < side; z += kBlock) {
    for (int y = 0; y < side; y += kBlock) {
      for (int x = 0; x < side; x += kBlock) sample_block(field, {x, y, z}, grid);
    }
  }
  return grid;
}

void write_grid(const Grid& grid, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(grid.values.data()),
             static_cast<std::streamsize>(grid.values.size() * sizeof(float)));
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

// A program to contour with: its triangles, every time again.
struct Contourer {
  std::string name;
  std::function<std::size_t()> triangles;
};

#ifdef BARKRIDGE_BENCH_OPENVDB
openvdb::FloatGrid::Ptr sparse(Grid& grid) {
  openvdb::initialize();
  const openvdb::CoordBBox box(openvdb::Coord(0), openvdb::Coord(grid.side - 1));
  const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, grid.values.data());
  const openvdb::FloatGrid::Ptr result = openvdb::FloatGrid::create(0.0f);
  openvdb::tools::copyFromDense(dense, *result, 0.0f);
  return result;
}

std::size_t openvdb_triangles(const openvdb::FloatGrid& grid) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(grid, points, triangles, quads, kIsoValue, 0.0);
  return triangles.size() + 2 * quads.size();
}
#endif

void measure(const Options& options) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
  const SampleTree sample = sample_tree({.internodes = 200, .exponent = 2});
  const std::shared_ptr<const Field> field = compile(tree_from_skeleton(sample.skeleton, surface_options("smooth")));
  const Stopwatch watch;
  Grid grid = sampled(*field, options.side);
  nlohmann::json numbers{{"cell", grid.cell}, {"sampling", watch.seconds()}};
  if (!options.write.empty()) write_grid(grid, options.write);

  PolygonizeOptions lattice;
  lattice.cell_size = grid.cell;
  PolygonizeOptions signs_alone = lattice;
  signs_alone.close_creases = false;
  std::vector<Contourer> contourers{
      {"barkridge polygonize", [&] { return polygonize(*field, lattice).triangles.size(); }},
      {"barkridge polygonize, signs alone", [&] { return polygonize(*field, signs_alone).triangles.size(); }}};
#ifdef BARKRIDGE_BENCH_OPENVDB
  const openvdb::FloatGrid::Ptr volume = sparse(grid);
  contourers.push_back(
      {"OpenVDB " OPENVDB_LIBRARY_VERSION_STRING " volumeToMesh", [volume] { return openvdb_triangles(*volume); }});
#endif
  std::vector<Measurement> measurements;
  for (const Contourer& contourer : contourers) {
    measurements.emplace_back([&] {
      const Stopwatch one;
      numbers["contourers"][contourer.name]["triangles"] = contourer.triangles();
      return one.seconds();
    });
  }
  const std::vector<Samples> seconds = take_turns(measurements, options.turns);
  for (std::size_t i = 0; i < contourers.size(); ++i) {
    numbers["contourers"][contourers[i].name]["seconds"] = seconds[i].median();
  }
  fmt::print("{}\n", numbers.dump());
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  barkridge::bench::Options options;
  CLI::App app;
  app.add_option("--side", options.side, "Points along a side of the grid")->capture_default_str();
  app.add_option("--threads", options.threads)->capture_default_str();
  app.add_option("--turns", options.turns)->capture_default_str();
  app.add_option("--write-grid", options.write, "Write the values, single precision, x fastest, to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    barkridge::bench::measure(options);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 1;
  }
}
