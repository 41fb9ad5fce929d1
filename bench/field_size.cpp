// What do points and restrictions cost in models of any size, and what does it cost to compile them?

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "base/random.h"
#include "bench/support/machine.h"
#include "bench/support/sample_tree.h"
#include "bench/support/study.h"
#include "bench/support/surfaces.h"
#include "bench/support/timing.h"

namespace barkridge::bench {

namespace {

constexpr std::size_t kPlaces = 4096;

struct Options {
  std::vector<std::size_t> sizes{2000, 20000, 200000, 1000000};
  std::string surface = "ridge";
  int turns = 3;
  double slice = 0.1;
};

// Points on the surface, anywhere in the tree, and boxes around them four local radii wide.
struct Places {
  std::vector<Vec3> points;
  std::vector<Box> boxes;
};

Places places_on(const Skeleton& skeleton) {
  Places places;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const std::size_t internode = hash_keys(1, i) % skeleton.internodes.size();
    const Internode& a = skeleton.internodes[internode];
    Vec3 across, other;
    complete_frame(glm::normalize(a.tip - a.base), across, other);
    const Vec3 point = a.base + random_unit(2, i) * (a.tip - a.base) + a.base_radius * across;
    places.points.push_back(point);
    places.boxes.push_back(grown({point, point}, 2 * a.base_radius));
  }
  return places;
}

struct Model {
  std::size_t size = 0;
  std::size_t primitives = 0;
  double compile_seconds = 0, bytes = 0;
  std::shared_ptr<const Field> field;
  Places places;
  double left = 0;  // primitives in a restriction
};

double compile_seconds(const BlobTree& tree) {
  const Stopwatch watch;
  compile(tree);
  return watch.seconds();
}

Model compiled_model(std::size_t size, const Options& options) {
  Model model;
  model.size = size;
  const Skeleton skeleton = sample_tree({.internodes = size}).skeleton;
  model.places = places_on(skeleton);
  const BlobTree tree = tree_from_skeleton(skeleton, surface_options(options.surface));
  Samples seconds;
  for (int turn = 0; turn < options.turns; ++turn) seconds.values.push_back(compile_seconds(tree));
  model.compile_seconds = seconds.median();

  release_free_memory();
  const std::size_t before = resident_memory();
  model.field = compile(tree);
  release_free_memory();
  model.bytes = static_cast<double>(resident_memory()) - static_cast<double>(before);
  model.primitives = model.field->primitive_count();
  return model;
}

// Of a batch whose points come from anywhere in the tree, as large as the slice allows.
double seconds_per_point(const Model& model, double slice) {
  std::vector<double> values(kPlaces);
  std::size_t count = 64;
  const auto evaluate = [&] {
    model.field->values(std::span(model.places.points).first(count), std::span(values).first(count));
  };
  while (count < kPlaces && seconds_per_call(0, evaluate) < slice) count *= 2;
  return seconds_per_call(slice, evaluate) / static_cast<double>(count);
}

double seconds_per_restriction(Model& model, double slice) {
  std::size_t restrictions = 0, left = 0;
  const double seconds = seconds_per_call(
      slice, [&] { left += model.field->restricted(model.places.boxes[restrictions++ % kPlaces])->primitive_count(); });
  model.left = static_cast<double>(left) / static_cast<double>(restrictions);
  return seconds;
}

void measure(const Options& options, Study& study) {
  std::vector<Model> models;
  for (const std::size_t size : options.sizes) models.push_back(compiled_model(size, options));
  std::vector<Measurement> measurements;
  for (Model& model : models) {
    measurements.emplace_back([&] { return seconds_per_point(model, options.slice); });
    measurements.emplace_back([&] { return seconds_per_restriction(model, options.slice); });
  }
  const std::vector<Samples> seconds = take_turns(measurements, options.turns);

  Table table{.title = "Sample trees, " + options.surface,
              .columns = {"internodes", "primitives", "compile s", "bytes/primitive", "values ns/point",
                          "restricted us", "primitives left"},
              .rows = {},
              .notes = {"bytes: resident memory that compile keeps, while the tree is kept too",
                        "values: of the whole model, points on the surface anywhere in the tree, one batch, one thread",
                        "restricted: of the whole model to boxes four local radii wide around such points"}};
  for (std::size_t i = 0; i < models.size(); ++i) {
    const Model& model = models[i];
    const double bytes = model.bytes / static_cast<double>(model.primitives);
    table.rows.push_back({model.size, model.primitives, model.compile_seconds, bytes, 1e9 * seconds[2 * i].median(),
                          1e6 * seconds[2 * i + 1].median(), model.left});
    const std::string size = std::to_string(model.size);
    study.figure("compile_seconds_" + size, model.compile_seconds);
    study.figure("compile_bytes_" + size, bytes);
  }
  const std::size_t last = 2 * (models.size() - 1);
  table.notes.push_back(
      fmt::format("from the smallest to the largest: a point costs {:.2f} times as much, a restriction {:.2f} times",
                  paired_ratio(seconds[last], seconds[0]), paired_ratio(seconds[last + 1], seconds[1])));
  study.add(std::move(table));
}

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  Options options;
  return run_study(
      argc, argv,
      Study("field_size",
            "What do points and restrictions cost in models of any size, and what does it cost to compile them?"),
      [&](CLI::App& app) {
        app.add_option("--sizes", options.sizes, "Numbers of internodes, small first")
            ->delimiter(',')
            ->capture_default_str();
        app.add_option("--surface", options.surface, "smooth, ridge or bend")->capture_default_str();
        app.add_option("--turns", options.turns, "Turns of every measurement")->capture_default_str();
        app.add_option("--slice", options.slice, "Seconds of a measurement")->capture_default_str();
      },
      [&](Study& study) { measure(options, study); });
}
