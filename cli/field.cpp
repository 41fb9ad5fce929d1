#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "base/error.h"
#include "cli/points.h"
#include "cli/progress_bar.h"
#include "cli/results.h"
#include "cli/verbs.h"
#include "cli/warning.h"
#include "scene/pipeline.h"

namespace barkridge::cli {

namespace {

constexpr std::size_t kBatch = 4096;

void print_batch(const Field& field, const std::vector<Vec3>& points) {
  std::vector<double> values(points.size());
  std::vector<Vec3> gradients(points.size());
  field.values_and_gradients(points, values, gradients);
  fmt::memory_buffer text;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i], g = gradients[i];
    fmt::format_to(std::back_inserter(text), "{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z,
                   values[i], g.x, g.y, g.z);
  }
  write_results({text.data(), text.size()});
}

void print_field(const Field& field, std::istream& lines, const std::string& file) {
  std::vector<Vec3> points;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (const std::optional<Vec3> point = parse_point(line, file, number)) points.push_back(*point);
    if (points.size() == kBatch) {
      print_batch(field, points);
      points.clear();
    }
  }
  if (lines.bad()) throw IoError(file, "cannot be read");
  print_batch(field, points);
}

}  // namespace

void run(const FieldArguments& arguments) {
  const Scene scene = load_scene(arguments.path, arguments.overrides);
  std::ifstream file;
  if (arguments.points != "-") {
    file.open(arguments.points);
    if (!file) throw InputError({arguments.points, 0, 0, ""}, "cannot be read");
  }
  std::shared_ptr<const Field> field;
  {
    ProgressBar bar(arguments.quiet);
    field = reference_field(make_model(scene, {bar.stage("growing"), warn}).tree);
  }
  if (arguments.points == "-") {
    print_field(*field, std::cin, "standard input");
  } else {
    print_field(*field, file, arguments.points);
  }
}

}  // namespace barkridge::cli
