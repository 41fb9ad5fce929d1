// How does the time of a picture grow with the model, and what do ridges and bends cost?

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "bench/support/machine.h"
#include "bench/support/sample_tree.h"
#include "bench/support/study.h"
#include "bench/support/surfaces.h"
#include "bench/support/ways.h"
#include "raytrace/render.h"

namespace barkridge::bench {

namespace {

struct Options {
  std::vector<std::size_t> sizes{200, 2000, 20000, 200000, 1000000};
  std::vector<std::string> surfaces = kSurfaces;
  std::set<int> threads{1, core_count()};
  int turns = 3;
  int width = 768, height = 1024;
  int limit = 600;
  bool once = false;
};

// The whole tree in a sun like a point, nothing else.
RenderScene scene_of(const Options& options) {
  constexpr double kHalfWidth = 10.5 * std::numbers::pi / 180;
  RenderScene scene;
  scene.camera.position = {0.35, 0.62, -2.35};
  scene.camera.target = {0, 0.5, 0};
  scene.camera.fov_degrees =
      2 * std::atan(std::tan(kHalfWidth) * options.height / options.width) * 180 / std::numbers::pi;
  scene.sun.direction = {-4, 6, -5};
  scene.sun.angle_degrees = 0;
  scene.sky.intensity = 0;
  scene.ground.enabled = false;
  scene.material.specular = 0;
  return scene;
}

// One run of the first size, surface and number of threads.
void run(const Options& options) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(*options.threads.begin()));
  const Skeleton skeleton = sample_tree({.internodes = options.sizes.front()}).skeleton;
  const TreeOptions surface = surface_options(options.surfaces.front());
  const RenderScene scene = scene_of(options);
  RenderOptions picture;
  picture.width = options.width;
  picture.height = options.height;
  picture.samples_per_pixel = 1;
  picture.bounces = 0;
  run_once(options.limit, [&] {
    const Stopwatch all;
    const BlobTree tree = tree_from_skeleton(skeleton, surface);
    const double planted = all.seconds();
    const std::shared_ptr<const Field> field = compile(tree);
    const double compiled = all.seconds();
    const Image image = render(*field, scene, picture);
    const double total = all.seconds();
    double covered = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) covered += image.rgba[i];
    return Numbers{{"tree", planted},
                   {"compile", compiled - planted},
                   {"render", total - compiled},
                   {"total", total},
                   {"covered", 4 * covered / static_cast<double>(image.rgba.size())}};
  });
}

std::vector<Way> ways_of(const Options& options) {
  std::vector<Way> ways;
  for (const std::size_t size : options.sizes) {
    for (const int threads : options.threads) {
      for (const std::string& surface : options.surfaces) {
        Way way{fmt::format("{}", size), surface, threads, {}, {}};
        way.arguments = {"--once",
                         "--sizes",
                         way.model,
                         "--surfaces",
                         surface,
                         "--threads",
                         fmt::format("{}", threads),
                         "--picture",
                         fmt::format("{},{}", options.width, options.height),
                         "--limit",
                         fmt::format("{}", options.limit)};
        ways.push_back(std::move(way));
      }
    }
  }
  return ways;
}

Table time_table(const std::vector<Way>& ways, const Options& options) {
  Table table{.title = fmt::format("{} x {}, one sample, a sun like a point", options.width, options.height),
              .columns = {"internodes", "surface", "threads", "tree s", "compile s", "render s", "least", "most",
                          "total s", "covered %", "peak MB"},
              .rows = {},
              .notes = {fmt::format("medians of {} processes; what is short is repeated warm in each", options.turns),
                        fmt::format("failed: too much memory, or more than {} s", options.limit),
                        "bend: ridge with internodes bent by 25 degrees"}};
  for (const Way& way : ways) {
    const auto render = way.numbers.find("render");
    if (render == way.numbers.end()) {
      table.rows.push_back({way.model, way.surface, way.threads, "failed"});
      continue;
    }
    table.rows.push_back({way.model, way.surface, way.threads, way.median("tree"), way.median("compile"),
                          render->second.median(), render->second.lowest(), render->second.highest(),
                          way.median("total"), 100 * way.median("covered"), 1e-6 * way.median("peak")});
  }
  return table;
}

// How a number grows when the model grows tenfold.
double growth_per_decade(const Way& small, const Way& large, const std::string& name) {
  const double decades = std::log10(std::stod(large.model) / std::stod(small.model));
  return std::pow(large.median(name) / small.median(name), 1 / decades);
}

Table growth_table(const std::vector<Way>& ways, Study& study, const Options& options) {
  Table table{.title = "Growth a decade of internodes",
              .columns = {"from", "to", "surface", "threads", "render", "total", "peak memory"},
              .rows = {},
              .notes = {}};
  const std::size_t step = options.surfaces.size() * options.threads.size();
  for (std::size_t i = step; i < ways.size(); ++i) {
    const Way &small = ways[i - step], &large = ways[i];
    const double render = growth_per_decade(small, large, "render");
    table.rows.push_back({small.model, large.model, large.surface, large.threads, render,
                          growth_per_decade(small, large, "total"), growth_per_decade(small, large, "peak")});
    if (large.surface == "ridge" && large.threads == *options.threads.rbegin()) {
      study.figure(fmt::format("render_growth_{}_{}", small.model, large.model), render);
    }
  }
  return table;
}

void measure(const Options& options, Study& study) {
  if (options.once) return run(options);
  std::vector<Way> ways = ways_of(options);
  run_in_turns(ways, options.turns);
  study.add(time_table(ways, options));
  add_surface_ratios(study, ways, "render", "render");
  study.add(growth_table(ways, study, options));
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--sizes", options.sizes, "Numbers of internodes, small first")->delimiter(',')->capture_default_str();
  app.add_option("--surfaces", options.surfaces, "Of smooth, ridge, bend")->delimiter(',')->capture_default_str();
  app.add_option("--threads", options.threads, "Numbers of threads")->delimiter(',')->capture_default_str();
  app.add_option("--turns", options.turns, "Processes for each")->capture_default_str();
  add_picture_option(app, options.width, options.height);
  app.add_option("--limit", options.limit, "Most seconds of a process")->capture_default_str();
  app.add_flag("--once", options.once, "Run only the first of each and print its numbers");
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  Options options;
  return run_study(
      argc, argv,
      Study("render_size", "How does the time of a picture grow with the model, and what do ridges and bends cost?"),
      [&](CLI::App& app) { add_options(app, options); }, [&](Study& study) { measure(options, study); });
}
