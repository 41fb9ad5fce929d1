// On how many wild trees does the surface keep the radii of its internodes, in one piece?

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>

#include "bench/support/study.h"
#include "bench/support/surfaces.h"
#include "mesh/topology.h"
#include "polygonize/polygonize.h"
#include "tests/support/dependability.h"

namespace barkridge::bench {

namespace {

using test::Dependability;
using test::Worst;

struct Options {
  int trees = 1000;
  std::uint64_t first = 0;
  int internodes = 30;
  std::vector<std::string> surfaces{"ridge", "smooth", "confined"};
  int meshes = 1000;
  int worst = 0;
  double round_turn_degrees = TreeOptions{}.round_turn_degrees;
};

struct Result {
  std::uint64_t seed = 0;
  Dependability surface;
  std::size_t pieces = 1;

  bool holds() const { return surface.holds() && pieces == 1; }
};

std::size_t pieces_of(const Field& field, const Skeleton& skeleton) {
  double thinnest = skeleton.internodes.front().base_radius;
  for (const Internode& a : skeleton.internodes) thinnest = std::min({thinnest, a.base_radius, a.tip_radius});
  PolygonizeOptions options;
  options.cell_size = 0.5 * thinnest;
  return examine(polygonize(field, options)).components;
}

Result result_of(std::uint64_t seed, const std::string& surface, const Options& options) {
  Result result;
  result.seed = seed;
  const Skeleton skeleton = test::wild_skeleton(seed, options.internodes);
  TreeOptions tree_options = surface_options(surface);
  tree_options.round_turn_degrees = options.round_turn_degrees;
  const auto field = compile(tree_from_skeleton(skeleton, tree_options));
  result.surface = test::dependability_of(skeleton, *field);
  if (seed < options.first + static_cast<std::uint64_t>(options.meshes)) result.pieces = pieces_of(*field, skeleton);
  return result;
}

std::vector<Result> results_of(const std::string& surface, const Options& options) {
  std::vector<Result> results(static_cast<std::size_t>(options.trees));
  tbb::parallel_for(std::size_t{0}, results.size(),
                    [&](std::size_t i) { results[i] = result_of(options.first + i, surface, options); });
  return results;
}

using Measure = std::function<const Worst&(const Result&)>;

// The trees at which a measure is worst, and where.
Table worst_table(const std::string& title, std::vector<Result> results, const Measure& measure, int count) {
  Table table{.title = title, .columns = {"seed", "value", "internode", "along", "azimuth"}, .rows = {}, .notes = {}};
  std::sort(results.begin(), results.end(),
            [&](const Result& a, const Result& b) { return measure(a).value > measure(b).value; });
  results.resize(std::min(results.size(), static_cast<std::size_t>(count)));
  for (const Result& result : results) {
    const Worst& worst = measure(result);
    table.rows.push_back({result.seed, worst.value, worst.internode, worst.along, worst.azimuth});
  }
  return table;
}

void measure(const Options& options, Study& study) {
  Table table{
      .title = "Wild trees",
      .columns = {"surface", "trees", "hold", "swell", "neck", "ring", "missing", "in pieces", "off axis",
                  "most swelling", "most necking", "highest ring", "most off axis"},
      .rows = {},
      .notes = {"swell, neck: by more than 5 %; ring: a rise of more than 1 %; missing: an axis outside",
                "off axis: a corner rounded by more than 5 %, which is no defect",
                fmt::format("in pieces: by meshes of the first {}, of two cells a thinnest radius", options.meshes)}};
  std::vector<Table> worst;
  for (const std::string& surface : options.surfaces) {
    const std::vector<Result> results = results_of(surface, options);
    const auto count = [&](auto fails) { return std::count_if(results.begin(), results.end(), fails); };
    const auto most = [&](const Measure& of) {
      double value = 0;
      for (const Result& result : results) value = std::max(value, of(result).value);
      return value;
    };
    const Measure swelling = [](const Result& r) -> const Worst& { return r.surface.swelling; };
    const Measure necking = [](const Result& r) -> const Worst& { return r.surface.necking; };
    const Measure ring = [](const Result& r) -> const Worst& { return r.surface.ring; };
    const Measure rounding = [](const Result& r) -> const Worst& { return r.surface.rounding; };
    const auto hold = count([](const Result& r) { return r.holds(); });
    table.rows.push_back({surface, options.trees, hold,
                          count([&](const Result& r) { return swelling(r).value > 0.05; }),
                          count([&](const Result& r) { return necking(r).value > 0.05; }),
                          count([&](const Result& r) { return ring(r).value > 0.01; }),
                          count([](const Result& r) { return r.surface.missing > 0; }),
                          count([](const Result& r) { return r.pieces != 1; }),
                          count([&](const Result& r) { return rounding(r).value > 0.05; }), most(swelling),
                          most(necking), most(ring), most(rounding)});
    study.figure("dependable_share_" + surface, static_cast<double>(hold) / options.trees);
    worst.push_back(worst_table(surface + ", swelling", results, swelling, options.worst));
    worst.push_back(worst_table(surface + ", necking", results, necking, options.worst));
    worst.push_back(worst_table(surface + ", rings", results, ring, options.worst));
  }
  study.add(std::move(table));
  for (Table& each : worst) study.add(std::move(each));
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  Options options;
  return run_study(
      argc, argv,
      Study("dependable", "On how many wild trees does the surface keep the radii of its internodes, in one piece?"),
      [&](CLI::App& app) {
        app.add_option("--trees", options.trees, "Number of trees")->capture_default_str();
        app.add_option("--first", options.first, "Seed of the first")->capture_default_str();
        app.add_option("--internodes", options.internodes, "Most internodes a tree")->capture_default_str();
        app.add_option("--surface", options.surfaces, "Any of smooth, ridge, bend and confined")
            ->delimiter(',')
            ->capture_default_str();
        app.add_option("--round-turn", options.round_turn_degrees, "Degrees up to which corners are rounded")
            ->capture_default_str();
        app.add_option("--meshes", options.meshes, "Number of trees of which the pieces are counted")
            ->capture_default_str();
        app.add_option("--worst", options.worst, "Show so many of the worst places")->capture_default_str();
      },
      [&](Study& study) { measure(options, study); });
}
