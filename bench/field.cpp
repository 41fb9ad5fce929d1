// How near does the evaluation of a block of points come to what the machine can do?

#include "bench/field_limit.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>

#include "base/random.h"
#include "bench/support/machine.h"
#include "bench/support/study.h"
#include "bench/support/timing.h"

namespace barkridge::bench {

namespace {

constexpr std::size_t kPoints = 6144, kPrimitives = 200;
constexpr Box kBlock{Vec3(-0.5), Vec3(0.5)};

struct Options {
  std::set<int> threads{1, core_count()};
  int turns = 5;
  double slice = 0.03;
};

Vec3 random_point(const Box& box, std::uint64_t purpose, std::size_t i) {
  const Vec3 unit(random_unit(purpose, i, 0), random_unit(purpose, i, 1), random_unit(purpose, i, 2));
  return box.lo + unit * (box.hi - box.lo);
}

// So thick that every one of them reaches all of the block.
std::vector<Cone> cones_around_block() {
  std::vector<Cone> cones;
  for (std::size_t i = 0; i < kPrimitives; ++i) {
    Cone cone{random_point(kBlock, 1, i), random_point(kBlock, 2, i), 1.5 + 0.5 * random_unit(3, i), 0};
    cone.tip_radius = cone.base_radius * (0.9 + 0.1 * random_unit(4, i));
    cones.push_back(cone);
  }
  return cones;
}

template <typename Primitive>
std::shared_ptr<const Field> sum_on_block(const std::vector<Primitive>& primitives) {
  BlobTree tree;
  std::vector<NodeId> children;
  for (const Primitive& primitive : primitives) children.push_back(tree.add(primitive));
  tree.add(Sum{}, std::move(children));
  std::shared_ptr<const Field> field = compile(tree)->restricted(kBlock);
  if (field->primitive_count() != kPrimitives) throw std::logic_error("a primitive does not reach the block");
  return field;
}

// The fade's windows are about as long as the radii: with short axes they cross the block, with long ones they lie far
// outside.
std::shared_ptr<const Field> faded_sum(const std::vector<Cone>& cones, bool windows_cross) {
  constexpr double kFar = 30;
  std::vector<FadedCone> faded;
  for (const Cone& cone : cones) {
    const Vec3 axis = glm::normalize(cone.tip - cone.base);
    const double margin = windows_cross ? 0 : kFar;
    faded.push_back({cone.base - margin * axis, cone.tip + margin * axis, cone.base_radius, cone.tip_radius,
                     cone.base_radius, cone.tip_radius});
  }
  return sum_on_block(faded);
}

// What a thread reads and writes.
struct Desk {
  std::vector<Vec3> points;
  std::vector<double> values = std::vector<double>(kPoints);
  std::vector<Vec3> gradients = std::vector<Vec3>(kPoints);
  LimitColumns columns;

  explicit Desk(std::vector<Vec3> places) : points(std::move(places)), columns(points) {}
};

using Evaluation = std::function<void(Desk&)>;

Evaluation evaluation_of(std::shared_ptr<const Field> field, bool gradients) {
  if (gradients) return [field](Desk& desk) { field->values_and_gradients(desk.points, desk.values, desk.gradients); };
  return [field](Desk& desk) { field->values(desk.points, desk.values); };
}

Evaluation limit_of(const std::vector<LimitCone>& cones, bool gradients, LimitLoop loop) {
  if (gradients) return [&cones, loop](Desk& desk) { limit_values_and_gradients(cones, desk.columns, loop); };
  return [&cones, loop](Desk& desk) { limit_values(cones, desk.columns, loop); };
}

// The limit is of no use if it computes something else.
void check_limit(const std::vector<LimitCone>& limit_cones, const Field& field, Desk& desk) {
  limit_values_and_gradients(limit_cones, desk.columns, LimitLoop::kTwoVectors);
  field.values_and_gradients(desk.points, desk.values, desk.gradients);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3 gradient(desk.columns.gx[i], desk.columns.gy[i], desk.columns.gz[i]);
    const bool equal = std::abs(desk.columns.f[i] - desk.values[i]) < 0.01 * desk.values[i] &&
                       glm::distance(gradient, desk.gradients[i]) < 0.01 * desk.values[i];
    if (!equal) throw std::logic_error("the limit and the field disagree");
  }
}

// Seconds of one evaluation a thread, all threads at it at once.
Measurement on_threads(const Evaluation& evaluate, std::vector<Desk>& desks, int threads, double slice) {
  const double once = seconds_per_call(0.1 * slice, [&] { evaluate(desks.front()); });
  const int repetitions = static_cast<int>(std::ceil(slice / once));
  return [&evaluate, &desks, threads, repetitions] {
    const auto work = [&](std::size_t thread) {
      for (int i = 0; i < repetitions; ++i) evaluate(desks[thread]);
    };
    return seconds_on_threads(threads, work) / repetitions;
  };
}

// The worst of each, over what was measured.
struct Worst {
  double share = std::numeric_limits<double>::infinity(), faded = 0;
};

class FieldStudy {
 public:
  explicit FieldStudy(const Options& options) : options_(options) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < kPoints; ++i) points.push_back(random_point(kBlock, 5, i));
    for (int k = 0; k < std::max(1, *options.threads.rbegin()); ++k) desks_.emplace_back(points);
    for (const Cone& cone : cones_) limit_cones_.emplace_back(cone);
  }

  void measure(Study& study) {
    Table table{.title = fmt::format("{} primitives at {} points, G primitive-points/s", kPrimitives, kPoints),
                .columns = {"set", "threads", "of", "limit", "cones", "share %", "faded elsewhere", "faded here",
                            "faded/plain"},
                .rows = {},
                .notes = {"limit: capsules in single precision, projected, fused, one division, nothing else",
                          "faded elsewhere: the block lies between the windows; here: both windows cross it",
                          "faded/plain: time of faded here over that of cones"}};
    for (const std::int64_t target : instruction_sets()) {
      choose_instruction_set(target);
      for (const int threads : options_.threads) {
        for (const bool gradients : {false, true}) measure_row(target, threads, gradients, table);
      }
    }
    choose_instruction_set(0);
    study.add(std::move(table));
    study.figure("field_share_values", values_.share);
    study.figure("field_share_gradients", gradients_.share);
    study.figure("field_faded_values", values_.faded);
    study.figure("field_faded_gradients", gradients_.faded);
  }

 private:
  void measure_row(std::int64_t target, int threads, bool gradients, Table& table) {
    // Built here, so that nothing remembers another instruction set.
    const std::shared_ptr<const Field> plain = sum_on_block(cones_);
    check_limit(limit_cones_, *plain, desks_.front());
    const std::vector<Evaluation> evaluations{
        limit_of(limit_cones_, gradients, LimitLoop::kTwoVectors),
        limit_of(limit_cones_, gradients, LimitLoop::kFourVectors), evaluation_of(plain, gradients),
        evaluation_of(faded_sum(cones_, false), gradients), evaluation_of(faded_sum(cones_, true), gradients)};
    std::vector<Measurement> measurements;
    for (const Evaluation& evaluate : evaluations) {
      measurements.push_back(on_threads(evaluate, desks_, threads, options_.slice));
    }
    const std::vector<Samples> seconds = take_turns(measurements, options_.turns);
    const Samples& limit = seconds[0].median() < seconds[1].median() ? seconds[0] : seconds[1];
    const Samples &cones = seconds[2], &faded = seconds[4];
    const auto rate = [&](const Samples& s) { return 1e-9 * threads * kPoints * kPrimitives / s.median(); };
    const double share = paired_ratio(limit, cones), ratio = paired_ratio(faded, cones);
    table.rows.push_back({hwy::TargetName(target), threads, gradients ? "values, gradients" : "values", rate(limit),
                          rate(cones), 100 * share, rate(seconds[3]), rate(faded), ratio});
    Worst& worst = gradients ? gradients_ : values_;
    if (vector_width() >= kWide) worst.share = std::min(worst.share, share);
    worst.faded = std::max(worst.faded, ratio);
  }

  static constexpr std::size_t kWide = 8;  // the goal is about vectors of at least this many numbers

  Options options_;
  std::vector<Cone> cones_ = cones_around_block();
  std::vector<LimitCone> limit_cones_;
  std::vector<Desk> desks_;
  Worst values_, gradients_;
};

}  // namespace

}  // namespace barkridge::bench

int main(int argc, char** argv) {
  using namespace barkridge::bench;
  Options options;
  return run_study(
      argc, argv, Study("field", "How near does the evaluation of a block of points come to what the machine can do?"),
      [&](CLI::App& app) {
        app.add_option("--threads", options.threads, "Numbers of threads")->delimiter(',')->capture_default_str();
        app.add_option("--turns", options.turns, "Turns of every measurement")->capture_default_str();
        app.add_option("--slice", options.slice, "Seconds of a measurement")->capture_default_str();
      },
      [&](Study& study) { FieldStudy(options).measure(study); });
}
