// How long does it take from a skeleton to triangles, how does that grow, and what do ridges and bends cost?

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "bench/support/machine.h"
#include "bench/support/sample_tree.h"
#include "bench/support/study.h"
#include "bench/support/surfaces.h"
#include "bench/support/ways.h"
#include "polygonize/polygonize.h"

namespace barkridge::bench {

namespace {

// Cells that resolve twigs, where a case does not say.
constexpr double kCellPerRadius = 0.7;

struct Options {
  std::vector<std::string> cases{"200:0.004:2", "2000", "20000:0.0003"};
  bool huge = false;
  std::vector<std::string> surfaces = kSurfaces;
  std::set<int> threads{1, core_count()};
  int turns = 3;
  int limit = 600;
  bool once = false;
};

// A tree and the cells to mesh it with.
struct Case {
  SampleTreeOptions tree;
  double cell_size = 0;  // 0: by the thinnest radius
};

Case parse_case(const std::string& text) {
  Case result;
  std::istringstream parts(text);
  std::string part;
  if (std::getline(parts, part, ':')) result.tree.internodes = std::stoul(part);
  if (std::getline(parts, part, ':')) result.cell_size = std::stod(part);
  if (std::getline(parts, part, ':')) result.tree.exponent = std::stod(part);
  return result;
}

// One run of the first case, surface and number of threads.
void run(const Options& options) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(*options.threads.begin()));
  const Case asked = parse_case(options.cases.front());
  const SampleTree sample = sample_tree(asked.tree);
  const TreeOptions surface = surface_options(options.surfaces.front());
  PolygonizeOptions lattice;
  lattice.cell_size = asked.cell_size > 0 ? asked.cell_size : kCellPerRadius * sample.thinnest_radius;
  run_once(options.limit, [&] {
    const Stopwatch all;
    const BlobTree tree = tree_from_skeleton(sample.skeleton, surface);
    const double planted = all.seconds();
    const std::shared_ptr<const Field> field = compile(tree);
    const double compiled = all.seconds();
    const Mesh mesh = polygonize(*field, lattice);
    const double total = all.seconds();
    return Numbers{{"tree", planted},
                   {"compile", compiled - planted},
                   {"polygonize", total - compiled},
                   {"total", total},
                   {"triangles", static_cast<double>(mesh.triangles.size())},
                   {"cell", lattice.cell_size},
                   {"thinnest", sample.thinnest_radius}};
  });
}

std::vector<Way> ways_of(const Options& options) {
  std::vector<Way> ways;
  for (const std::string& name : options.cases) {
    for (const int threads : options.threads) {
      for (const std::string& surface : options.surfaces) {
        Way way{name, surface, threads, {}, {}};
        way.arguments = {"--once",
                         "--cases",
                         name,
                         "--surfaces",
                         surface,
                         "--threads",
                         fmt::format("{}", threads),
                         "--limit",
                         fmt::format("{}", options.limit)};
        ways.push_back(std::move(way));
      }
    }
  }
  return ways;
}

double million_triangles_per_second(const Way& way) { return 1e-6 * way.median("triangles") / way.median("total"); }

Table time_table(const std::vector<Way>& ways, const Options& options) {
  Table table{.title = "From skeleton to triangles",
              .columns = {"case", "cell", "thinnest radius/cell", "surface", "threads", "tree s", "compile s",
                          "polygonize s", "total s", "least", "most", "M triangles", "M triangles/s", "peak MB"},
              .rows = {},
              .notes = {"case: internodes, cell size where given, exponent of the radii's rule where given",
                        fmt::format("medians of {} processes; what is short is repeated warm in each", options.turns),
                        fmt::format("failed: too much memory, or more than {} s", options.limit),
                        "bend: ridge with internodes bent by 25 degrees"}};
  for (const Way& way : ways) {
    const auto total = way.numbers.find("total");
    if (total == way.numbers.end()) {
      table.rows.push_back({way.model, nullptr, nullptr, way.surface, way.threads, "failed"});
      continue;
    }
    table.rows.push_back({way.model, way.median("cell"), way.median("thinnest") / way.median("cell"), way.surface,
                          way.threads, way.median("tree"), way.median("compile"), way.median("polygonize"),
                          total->second.median(), total->second.lowest(), total->second.highest(),
                          1e-6 * way.median("triangles"), million_triangles_per_second(way),
                          1e-6 * way.median("peak")});
  }
  return table;
}

// What a triangle costs against the case before: 1 when the cost is linear in triangles.
Table growth_table(const std::vector<Way>& ways, Study& study, const Options& options) {
  Table table{.title = "Cost of a triangle against the case before",
              .columns = {"from", "to", "surface", "threads", "triangles", "time", "memory", "time/triangle"},
              .rows = {},
              .notes = {"factors; time a triangle stays 1 where cost is linear in triangles"}};
  const std::size_t step = options.surfaces.size() * options.threads.size();
  for (std::size_t i = step; i < ways.size(); ++i) {
    const Way &small = ways[i - step], &large = ways[i];
    const auto factor = [&](const std::string& name) { return large.median(name) / small.median(name); };
    const double cost = factor("total") / factor("triangles");
    table.rows.push_back({small.model, large.model, large.surface, large.threads, factor("triangles"), factor("total"),
                          factor("peak"), cost});
    if (large.surface == "ridge" && large.threads == *options.threads.rbegin()) {
      study.figure(fmt::format("mesh_cost_{}", large.model), cost);
    }
  }
  return table;
}

void measure(Options options, Study& study) {
  if (options.once) return run(options);
  if (options.huge) options.cases.emplace_back("200000");
  std::vector<Way> ways = ways_of(options);
  run_in_turns(ways, options.turns);
  study.add(time_table(ways, options));
  add_surface_ratios(study, ways, "total", "mesh");
  study.add(growth_table(ways, study, options));
  for (const Way& way : ways) {
    if (way.surface != "ridge" || way.threads != *options.threads.rbegin()) continue;
    study.figure(fmt::format("mesh_rate_{}", way.model), million_triangles_per_second(way));
  }
}

void add_options(CLI::App& app, Options& options) {
  app.add_option(
         "--cases", options.cases,
         "N, N:CELL or N:CELL:EXPONENT; cells are 0.7 of the thinnest radius, and twigs a sixtieth of the trunk, "
         "where not given")
      ->delimiter(',')
      ->capture_default_str();
  app.add_flag("--huge", options.huge, "200000 internodes too, in hundreds of millions of triangles");
  app.add_option("--surfaces", options.surfaces, "Of smooth, ridge, bend")->delimiter(',')->capture_default_str();
  app.add_option("--threads", options.threads, "Numbers of threads")->delimiter(',')->capture_default_str();
  app.add_option("--turns", options.turns, "Processes for each")->capture_default_str();
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
      Study(
          "mesh_size",
          "How long does it take from a skeleton to triangles, how does that grow, and what do ridges and bends cost?"),
      [&](CLI::App& app) { add_options(app, options); }, [&](Study& study) { measure(options, study); });
}
