// How long does Loop subdivision take from a coarse mesh to refined triangles, beside OpenSubdiv?

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <stdexcept>

#include "bench/support/machine.h"
#include "bench/support/sample_tree.h"
#include "bench/support/study.h"
#include "bench/support/timing.h"
#include "subdivision/limit.h"
#include "subdivision/loop.h"

namespace barkridge::bench {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr std::uint32_t kSides = 6;

struct Options {
  std::vector<std::size_t> sizes{200, 2000, 20000};
  std::vector<int> levels{1, 2, 3, 4};
  std::size_t most_triangles = 40'000'000;
  std::set<int> threads{1, core_count()};
  int turns = 5;
};

// A closed six-sided tube for each internode, 24 triangles.
ControlMesh tubes(const Skeleton& skeleton) {
  ControlMesh mesh;
  for (const Internode& internode : skeleton.internodes) {
    const auto start = static_cast<std::uint32_t>(mesh.positions.size());
    Vec3 u, v;
    complete_frame(glm::normalize(internode.tip - internode.base), u, v);
    for (const bool tip : {false, true}) {
      const Vec3& center = tip ? internode.tip : internode.base;
      const double radius = tip ? internode.tip_radius : internode.base_radius;
      for (std::uint32_t i = 0; i < kSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kSides;
        mesh.positions.emplace_back(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
      }
    }
    mesh.positions.emplace_back(internode.base);
    mesh.positions.emplace_back(internode.tip);
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = start + i, b = start + (i + 1) % kSides, c = b + kSides, d = a + kSides;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      mesh.triangles.insert(mesh.triangles.end(), {{start + 2 * kSides, b, a}, {start + 2 * kSides + 1, d, c}});
    }
  }
  return mesh;
}

// What OpenSubdiv interpolates.
struct Point {
  float x = 0, y = 0, z = 0;
  void Clear(void* = nullptr) { x = y = z = 0; }
  void AddWithWeight(const Point& other, float weight) {
    x += weight * other.x;
    y += weight * other.y;
    z += weight * other.z;
  }
};

// The same work by OpenSubdiv: topology, refinement, positions of every level, triangles of the last.
std::size_t opensubdiv(const ControlMesh& mesh, int levels) {
  const std::vector<int> sizes(mesh.triangles.size(), 3);
  Far::TopologyDescriptor topology;
  topology.numVertices = static_cast<int>(mesh.positions.size());
  topology.numFaces = static_cast<int>(mesh.triangles.size());
  topology.numVertsPerFace = sizes.data();
  topology.vertIndicesPerFace = reinterpret_cast<const int*>(mesh.triangles.data());
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(topology, Factory::Options(Sdc::SCHEME_LOOP, options)));
  if (!refiner) throw std::runtime_error("OpenSubdiv refuses the mesh");
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = false;
  refiner->RefineUniform(uniform);

  const auto* first = reinterpret_cast<const Point*>(mesh.positions.data());
  std::vector<Point> points(first, first + mesh.positions.size()), next;
  const Far::PrimvarRefiner primvars(*refiner);
  for (int level = 1; level <= levels; ++level) {
    next.resize(static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
    primvars.Interpolate(level, points, next);
    points.swap(next);
  }
  const Far::TopologyLevel& last = refiner->GetLevel(levels);
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(static_cast<std::size_t>(last.GetNumFaces()));
  for (int face = 0; face < last.GetNumFaces(); ++face) {
    const Far::ConstIndexArray corners = last.GetFaceVertices(face);
    triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return triangles.size() + points.size();
}

double seconds_of(const std::function<std::size_t()>& work) {
  const Stopwatch stopwatch;
  if (work() == 0) throw std::runtime_error("nothing was made");
  return stopwatch.seconds();
}

Measurement on_threads(int threads, const std::function<std::size_t()>& work) {
  return [threads, work] {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    return seconds_of(work);
  };
}

void measure_case(const ControlMesh& mesh, std::size_t internodes, int levels, const Options& options, Table& table,
                  Study& study) {
  std::vector<Measurement> measurements{[&] { return seconds_of([&] { return opensubdiv(mesh, levels); }); }};
  for (const int threads : options.threads) {
    measurements.push_back(on_threads(threads, [&] { return subdivide(mesh, levels).triangles.size(); }));
    measurements.push_back(on_threads(threads, [&] { return limit_surface(mesh, levels).triangles.size(); }));
  }
  const std::vector<Samples> samples = take_turns(measurements, options.turns);
  const double million = 1e-6 * static_cast<double>(mesh.triangles.size()) * std::pow(4.0, levels);
  std::size_t next = 1;
  for (const int threads : options.threads) {
    const Samples &ours = samples[next], &limit = samples[next + 1];
    const double ratio = paired_ratio(samples[0], ours);
    table.rows.push_back({internodes, levels, million, threads, samples[0].median(), ours.median(), ours.lowest(),
                          ours.highest(), ratio, million / ours.median(), limit.median()});
    const bool all = threads == *options.threads.rbegin();
    if (all) study.figure(fmt::format("loop_{}_level_{}", internodes, levels), ratio);
    if (threads == 1) study.figure(fmt::format("loop_{}_level_{}_one_thread", internodes, levels), ratio);
    next += 2;
  }
}

void measure(const Options& options, Study& study) {
  Table table{.title = "From coarse mesh to refined triangles",
              .columns = {"internodes", "level", "M triangles", "threads", "OpenSubdiv s", "ours s", "least", "most",
                          "times as fast", "M triangles/s", "with limit s"},
              .rows = {},
              .notes = {fmt::format("24 coarse triangles an internode; medians of {} turns", options.turns),
                        "OpenSubdiv: Far, which uses one thread: create, refine, interpolate, read triangles out",
                        "ours: checks of the mesh included; limit: positions and normals of the limit surface",
                        fmt::format("left out: more than {} triangles", options.most_triangles)}};
  for (const std::size_t internodes : options.sizes) {
    SampleTreeOptions tree;
    tree.internodes = internodes;
    const ControlMesh mesh = tubes(sample_tree(tree).skeleton);
    for (const int levels : options.levels) {
      if (mesh.triangles.size() << (2 * levels) > options.most_triangles) continue;
      measure_case(mesh, internodes, levels, options, table, study);
    }
  }
  study.add(table);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--sizes", options.sizes, "Internodes of the trees")->delimiter(',')->capture_default_str();
  app.add_option("--levels", options.levels, "Levels of subdivision")
      ->delimiter(',')
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  app.add_option("--most", options.most_triangles, "Most triangles of a case")->capture_default_str();
  app.add_option("--threads", options.threads, "Numbers of threads")->delimiter(',')->capture_default_str();
  app.add_option("--turns", options.turns, "Runs of each")->capture_default_str();
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  Options options;
  return run_study(
      argc, argv,
      Study("loop", "How long does Loop subdivision take from a coarse mesh to refined triangles, beside OpenSubdiv?"),
      [&](CLI::App& app) { add_options(app, options); }, [&](Study& study) { measure(options, study); });
}
