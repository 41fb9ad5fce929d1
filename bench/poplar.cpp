// How long does the README's picture of the poplar take?

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "bench/support/machine.h"
#include "bench/support/study.h"
#include "bench/support/timing.h"
#include "bench/support/ways.h"
#include "raytrace/image_file.h"
#include "scene/pipeline.h"

namespace barkridge::bench {

namespace {

struct Options {
  int width = 1536, height = 2048;
  int samples = 9;
  int turns = 3;
  int limit = 600;
  bool once = false;
};

// The program's steps, as `barkridge render` takes them.
Numbers make_picture(const Options& options, const std::string& output) {
  const Stopwatch all;
  Scene scene = load_scene(BARKRIDGE_SOURCE_DIR "/scenes/poplar.toml");
  scene.image.width = options.width;
  scene.image.height = options.height;
  scene.image.samples_per_pixel = options.samples;
  prepare_image_writing({output});
  const Model model = make_model(scene);
  const double grown = all.seconds();
  const std::shared_ptr<const Field> field = compile(model.tree);
  const double compiled = all.seconds();
  const Image image = render(*field, make_render_scene(scene, model, *field), scene.image);
  const double rendered = all.seconds();
  write_picture(image, scene, model, output);
  const double total = all.seconds();
  return {{"internodes", static_cast<double>(model.skeleton.internodes.size())},
          {"grow", grown},
          {"compile", compiled - grown},
          {"render", rendered - compiled},
          {"write", total - rendered},
          {"total", total}};
}

void run(const Options& options) {
  const std::filesystem::path output =
      std::filesystem::temp_directory_path() / fmt::format("barkridge_bench_poplar_{}.png", ::getpid());
  run_once(options.limit, [&] { return make_picture(options, output.string()); });
  std::filesystem::remove(output);
}

void measure(const Options& options, Study& study) {
  if (options.once) return run(options);
  std::vector<Way> ways{{"poplar", "ridge", core_count(), {}, {}}};
  Way& way = ways.front();
  way.arguments = {"--once",
                   "--picture",
                   fmt::format("{},{}", options.width, options.height),
                   "--spp",
                   fmt::format("{}", options.samples),
                   "--limit",
                   fmt::format("{}", options.limit)};
  run_in_turns(ways, options.turns);
  Table table{.title = fmt::format("scenes/poplar.toml, {} x {}, at most {} samples, to PNG", options.width,
                                   options.height, options.samples),
              .columns = {"internodes", "threads", "grow s", "compile s", "render s", "write s", "total s", "least",
                          "most", "peak MB"},
              .rows = {},
              .notes = {}};
  if (way.numbers.empty()) {
    table.rows.push_back({"failed"});
    table.notes.push_back(fmt::format("failed: too much memory, or more than {} s", options.limit));
  } else {
    const Samples& total = way.numbers.at("total");
    table.rows.push_back({static_cast<std::int64_t>(way.median("internodes")), way.threads, way.median("grow"),
                          way.median("compile"), way.median("render"), way.median("write"), total.median(),
                          total.lowest(), total.highest(), 1e-6 * way.median("peak")});
  }
  study.add(std::move(table));
  study.figure(fmt::format("poplar_{}x{}_{}", options.width, options.height, options.samples), way.median("total"));
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  Options options;
  return run_study(
      argc, argv, Study("poplar", "How long does the README's picture of the poplar take?"),
      [&](CLI::App& app) {
        add_picture_option(app, options.width, options.height);
        app.add_option("--spp", options.samples, "Most samples a pixel")->capture_default_str();
        app.add_option("--turns", options.turns, "Processes")->capture_default_str();
        app.add_option("--limit", options.limit, "Most seconds of a process")->capture_default_str();
        app.add_flag("--once", options.once, "Run once and print the numbers");
      },
      [&](Study& study) { measure(options, study); });
}
