// Which trees do the studies measure?

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "bench/support/sample_tree.h"
#include "bench/support/study.h"
#include "bench/support/timing.h"

namespace barkridge::bench {

namespace {

struct Options {
  std::vector<std::size_t> sizes{200, 2000, 20000, 200000, 1000000};
  double exponent = 0;
  std::string write;
};

void write_table(const Skeleton& skeleton, const std::string& path) {
  std::ofstream file(path);
  file << write_skeleton_table(skeleton);
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

void measure(const Options& options, Study& study) {
  Table table{.title = "Sample trees",
              .columns = {"internodes", "tips", "exponent", "trunk/thinnest", "thinnest radius", "median length", "x",
                          "y", "z", "s"},
              .rows = {},
              .notes = {"height 1, trunk radius 0.025, radii by r^e = sum of the children's r^e"}};
  for (const std::size_t size : options.sizes) {
    const SampleTreeOptions tree_options{.internodes = size, .exponent = options.exponent};
    const Stopwatch watch;
    const SampleTree tree = sample_tree(tree_options);
    const double seconds = watch.seconds();
    const Vec3 extent = 2.0 * bounding_box(tree.skeleton).half_extent();
    table.rows.push_back({size, tree.tips, tree.exponent, tree_options.trunk_radius / tree.thinnest_radius,
                          tree.thinnest_radius, median_length(tree.skeleton), extent.x, extent.y, extent.z, seconds});
    if (!options.write.empty()) write_table(tree.skeleton, options.write);
  }
  study.add(std::move(table));
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  Options options;
  return run_study(
      argc, argv, Study("tree", "Which trees do the studies measure?"),
      [&](CLI::App& app) {
        app.add_option("--sizes", options.sizes, "Numbers of internodes")->delimiter(',')->capture_default_str();
        app.add_option("--exponent", options.exponent, "Exponent of the radii's rule; 0 makes twigs a sixtieth thin");
        app.add_option("--write", options.write, "Write the last tree's skeleton table to this file");
      },
      [&](Study& study) { measure(options, study); });
}
