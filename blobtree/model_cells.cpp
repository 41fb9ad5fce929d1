#include "blobtree/model_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "base/large_room.h"
#include "blobtree/falloff.h"
#include "blobtree/line_cones.h"
#include "blobtree/primitive.h"
#include "blobtree/tube.h"

namespace barkridge {

namespace {

using ModelPtr = std::shared_ptr<const FieldModel>;

// Where no operator makes more of its operands than their sum, times the gain of displacements, and k primitives matter
// at a point of the solid, the strongest of them has, times its gain, at least the k-th part of the iso-value there:
// the point is within that one's level of this normalised distance.
constexpr std::size_t kMostCounted = 32;

double level_distance(std::size_t count, double gain) {
  constexpr double kRounding = 1e-5;
  return falloff_distance(kIsoValue / (static_cast<double>(count) * gain)) * (1 + kRounding);
}

// Without displacements.
std::array<double, kMostCounted + 1> level_distances() {
  std::array<double, kMostCounted + 1> distances{};
  for (std::size_t k = 1; k <= kMostCounted; ++k) distances[k] = level_distance(k, 1);
  return distances;
}

// Cylinders of long slanting tubes fit into boxes but loosely: shorter pieces do better.
int piece_count(const Tube& tube) {
  constexpr double kLongest = 8;  // radii
  constexpr double kMostPieces = 8;
  Vec3 extent = glm::abs(tube.axis) * (tube.along.hi - tube.along.lo);
  std::sort(&extent.x, &extent.x + 3);
  return static_cast<int>(std::clamp(std::ceil(extent.y / (kLongest * tube.base_radius)), 1.0, kMostPieces));
}

// A cell and the primitives that matter in it, as a part of a list.
struct CellPlan {
  Cylinder cylinder;
  std::uint32_t first = 0, count = 0;
};

struct Plan {
  std::vector<CellPlan> cells;
  std::vector<std::uint32_t> primitives;
};

// Boxes side by side, so that a loop over them has no branch.
class BoxColumns {
 public:
  void clear() {
    for (std::vector<float>& column : columns_) column.clear();
  }
  void add(const Box& box) {
    for (int k = 0; k < 3; ++k) {
      columns_[static_cast<std::size_t>(k)].push_back(static_cast<float>(box.lo[k]));
      columns_[static_cast<std::size_t>(k) + 3].push_back(static_cast<float>(box.hi[k]));
    }
  }
  /// Whether each overlaps a box. As those here are of floats, rounding the box to the nearest floats, in whichever
  /// direction, changes no answer from yes to no.
  void find_overlapping(const Box& box, std::vector<std::uint8_t>& overlaps) const {
    overlaps.assign(columns_[0].size(), 1);
    for (int k = 0; k < 3; ++k) {
      const auto lo = static_cast<float>(box.lo[k]), hi = static_cast<float>(box.hi[k]);
      const std::vector<float>&los = columns_[static_cast<std::size_t>(k)],
            &his = columns_[static_cast<std::size_t>(k) + 3];
      for (std::size_t i = 0; i < overlaps.size(); ++i) {
        overlaps[i] &=
            static_cast<std::uint8_t>(static_cast<unsigned>(los[i] <= hi) & static_cast<unsigned>(lo <= his[i]));
      }
    }
  }

 private:
  std::array<std::vector<float>, 6> columns_;
};

// Plans the cells of primitives that are neighbours in space.
class Planner {
 public:
  Planner(const FieldModel& model, std::span<const Cylinder> supports, const Box& region)
      : model_(model), supports_(supports), region_(region) {}

  void plan(std::span<const std::uint32_t> neighbours, Plan& plan) {
    Box around;
    for (const std::uint32_t primitive : neighbours) around = unite(around, box_of_cells(primitive));
    around = intersect(around, region_);
    if (around.empty()) return;
    all_.clear();
    model_.supports.find(around, model_.cones.size(), all_);
    boxes_.clear();
    for (const std::uint32_t number : all_) boxes_.add(model_.supports.box(number));
    for (const std::uint32_t primitive : neighbours) plan_primitive(primitive, plan);
  }

 private:
  // Holds all cells of a primitive. Cylinders around parts of what is bent may reach out of that around the whole, by
  // less than its radius.
  Box box_of_cells(std::uint32_t primitive) const {
    const Cylinder& support = supports_[primitive];
    const Box box = box_around(support);
    return is_warped(model_, model_.sum_of(primitive)) ? grown(box, support.radius) : box;
  }

  void plan_primitive(std::uint32_t primitive, Plan& plan) {
    const std::uint32_t sum = model_.sum_of(primitive);
    if (only_takes_away(model_, sum)) return;
    const Cylinder& support = supports_[primitive];
    boxes_.find_overlapping(box_of_cells(primitive), overlaps_);
    near_.clear();
    bends_ = is_warped(model_, sum);
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (overlaps_[i] && (bends_ || may_overlap(support, supports_[all_[i]]))) near_.push_back(all_[i]);
    }
    reaching_ = near_;
    if (model_.other_at(primitive)) return add(support, plan);
    const Tube tube = tube_of(model_.cones[primitive], model_.kinds[primitive], model_.units.scale);
    if (tube.along.empty()) return;
    const int pieces = piece_count(tube);
    const double step = (tube.along.hi - tube.along.lo) / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double from = tube.along.lo + i * step, to = i + 1 < pieces ? from + step : tube.along.hi;
      add_piece(sum, tube, from, to, plan);
    }
  }

  // The fewer primitives reach a level, the narrower is the one that matters. A second round may count in the cylinder
  // of the first, since the strongest primitive at a point is the same one. [docs/field.md, "Cells"]
  void add_piece(std::uint32_t sum, const Tube& tube, double from, double to, Plan& plan) {
    static const std::array<double, kMostCounted + 1> kDistances = level_distances();
    reaching_ = near_;
    std::optional<Cylinder> cylinder = cylinder_of(model_, sum, tube, 1, from, to);
    constexpr int kRounds = 2;
    constexpr std::size_t kMany = 24;
    constexpr double kShort = 2;
    for (int round = 0; round < kRounds && cylinder && model_.is_below_sum && tube.has_levels; ++round) {
      keep_reaching(*cylinder);
      // Where many reach a long piece, fewer reach its halves.
      if (reaching_.size() > kMany && to - from > kShort * tube.base_radius) {
        const double middle = 0.5 * (from + to);
        add_piece(sum, tube, from, middle, plan);
        return add_piece(sum, tube, middle, to, plan);
      }
      if (reaching_.size() > kMostCounted) break;
      const std::size_t count = std::max<std::size_t>(1, reaching_.size());
      const auto gain = static_cast<double>(model_.operators[sum].gain);
      cylinder = cylinder_of(model_, sum, tube, gain > 1 ? level_distance(count, gain) : kDistances[count], from, to);
    }
    if (cylinder) add(*cylinder, plan);
  }

  // Cylinders around narrower levels lie within those around wider ones, unless they are bent.
  void keep_reaching(const Cylinder& cylinder) {
    if (bends_) reaching_ = near_;
    std::erase_if(reaching_, [&](std::uint32_t number) { return !may_overlap(cylinder, supports_[number]); });
  }

  void add(const Cylinder& cylinder, Plan& plan) {
    if (!box_around(cylinder).overlaps(region_)) return;
    keep_reaching(cylinder);
    plan.cells.push_back(
        {cylinder, static_cast<std::uint32_t>(plan.primitives.size()), static_cast<std::uint32_t>(reaching_.size())});
    plan.primitives.insert(plan.primitives.end(), reaching_.begin(), reaching_.end());
  }

  const FieldModel& model_;
  std::span<const Cylinder> supports_;
  const Box& region_;
  std::vector<std::uint32_t> all_;       // primitives that may matter to any of the neighbours
  BoxColumns boxes_;                     // around them
  std::vector<std::uint32_t> near_;      // those that may matter to one of the neighbours
  bool bends_ = false;                   // whether that one is warped
  std::vector<std::uint32_t> reaching_;  // those that reach a part of it
  std::vector<std::uint8_t> overlaps_;
};

// The roots on rays after a step of Newton's method, and the gradients where it was taken; returns those whose step was
// not too long.
RayLanes polish(const FieldModel& model, const FieldProgram& program, const RayBundle& bundle, RayLanes rays,
                const RayRanges& ranges, const std::array<RayRoot, RayBundle::kWidth>& roots,
                std::array<SurfacePoint, RayBundle::kWidth>& found) {
  std::array<Vec3, RayBundle::kWidth> points, gradients;
  std::array<double, RayBundle::kWidth> values;
  std::size_t count = 0;
  for_each_lane(rays, [&](std::size_t lane) { points[count++] = bundle.ray(lane).at(roots[lane].t); });
  evaluate(model, program, std::span(points).first(count), std::span(values).first(count),
           std::span(gradients).first(count));
  RayLanes done = 0;
  std::size_t next = 0;
  for_each_lane(rays, [&](std::size_t lane) {
    const std::size_t i = next++;
    const Interval range = ranges[lane];
    const double t = roots[lane].t;
    found[lane] = {t, gradients[i]};
    if (t > range.lo) {
      const double step = (kIsoValue - values[i]) / glm::dot(gradients[i], bundle.ray(lane).direction);
      if (!(std::abs(step) <= roots[lane].longest_step)) return;
      found[lane].t = std::clamp(t + step, range.lo, range.hi);
    }
    done |= RayLanes{1} << lane;
  });
  return done;
}

// Some rays of a bundle in a cell. Most of the few primitives that matter in it do not matter on the rays.
struct Search {
  const FieldModel& model;
  std::span<const std::uint32_t> primitives;
  const RayBundle& bundle;
  const RayRanges::Column& limits;
  double tolerance;
  bool any;  // whether any point will do
  std::array<SurfacePoint, RayBundle::kWidth>& found;

  // Returns the rays that meet the solid on parts of them.
  RayLanes run(RayLanes rays, const RayRanges& parts) const {
    if (rays == 0) return 0;
    thread_local LineMeeting meeting;
    meet(model, primitives, bundle, rays, parts, meeting);
    rays = meeting.rays;
    if (rays == 0) return 0;
    // Under warps and displacements only short pieces have good bounds.
    constexpr double kMuchShorter = 0.7, kMostVariation = 24;
    const double length = longest(rays, meeting.reach);
    const bool is_displaced = !model.displacements.empty();
    const bool may_shorten = (is_displaced || !model.warps.empty()) && length > 2 * tolerance;
    const RayRanges reach = meeting.reach;
    if (may_shorten && length < kMuchShorter * longest(rays, parts)) return run(rays, reach);
    thread_local FieldProgram met, rest;
    assemble(model, meeting.primitives, met);
    const FieldBounds bounds = bound_along(model, met, meeting, bundle, rest);
    if (bounds.value.hi < kIsoValue) return 0;
    const bool has_poor_bounds = is_displaced || std::isinf(bounds.second.lo);
    if (may_shorten && has_poor_bounds && bounds.slope * length > kMostVariation) {
      RayRanges half = reach;
      for (std::size_t i = 0; i < RayRanges::kWidth; ++i) half.hi[i] = 0.5 * (reach.lo[i] + reach.hi[i]);
      const RayLanes first = run(rays, half);
      half.lo = half.hi;
      half.hi = reach.hi;
      return first | run(rays & ~first, half);
    }
    return find(rest, bounds, rays, parts, reach);
  }

 private:
  RayLanes find(const FieldProgram& program, const FieldBounds& bounds, RayLanes rays, const RayRanges& parts,
                const RayRanges& reach) const {
    std::array<RayRoot, RayBundle::kWidth> roots;
    const auto search = [&](RayLanes some, SearchAim aim) {
      return search_along(model, program, bounds, bundle, some, reach, tolerance, aim, roots);
    };
    if (any) return search(rays, SearchAim::kAnyPoint);
    RayLanes hits = search(rays, SearchAim::kBeforeNewton);
    for_each_lane(hits, [&](std::size_t lane) {
      if (roots[lane].t - roots[lane].longest_step >= limits[lane]) hits &= ~(RayLanes{1} << lane);
    });
    if (hits == 0) return 0;
    const RayLanes polished = polish(model, program, bundle, hits, parts, roots, found);
    // A step that is too long comes of a ray that grazes, or of a field that bends up.
    const RayLanes others = hits & ~polished;
    if (others == 0) return polished;
    const RayLanes exact = search(others, SearchAim::kFirstPoint);
    polish(model, program, bundle, exact, parts, roots, found);
    return polished | exact;
  }

  double longest(RayLanes rays, const RayRanges& of) const {
    double length = 0;
    for_each_lane(rays, [&](std::size_t lane) { length = std::max(length, of.hi[lane] - of.lo[lane]); });
    return length;
  }
};

class ModelCells final : public SurfaceCells {
 public:
  ModelCells(ModelPtr model, const Box& region) : model_(std::move(model)), region_(region) {
    const std::vector<Cylinder> supports = support_cylinders(*model_);
    is_part_ = !region_.contains(model_->support.lo) || !region_.contains(model_->support.hi);
    constexpr std::size_t kChunk = 64;
    const std::size_t groups = model_->supports.group_count();
    std::vector<Plan> plans((groups + kChunk - 1) / kChunk);
    tbb::parallel_for(std::size_t{0}, plans.size(), [&](std::size_t i) {
      Planner planner(*model_, supports, region_);
      for (std::size_t g = i * kChunk; g < std::min(groups, (i + 1) * kChunk); ++g) {
        planner.plan(model_->supports.group(g), plans[i]);
      }
    });
    unite(plans);
  }

  std::size_t size() const override { return cells_.size(); }

  Box box(std::size_t cell) const override { return intersect(box_around(cells_[cell].cylinder()), region_); }

  RayLanes first_inside(std::size_t cell, const RayBundle& bundle, RayLanes rays, const RayRanges::Column& limits,
                        double tolerance, std::array<SurfacePoint, RayBundle::kWidth>& found) const override {
    RayRanges parts;
    RayLanes in_cell = clip_to_cell(cell, bundle, rays, parts);
    for_each_lane(in_cell, [&](std::size_t lane) {
      if (parts.lo[lane] >= limits[lane]) in_cell &= ~(RayLanes{1} << lane);
    });
    return Search{*model_, primitives_of(cells_[cell]), bundle, limits, tolerance, false, found}.run(in_cell, parts);
  }
  RayLanes any_inside(std::size_t cell, const RayBundle& bundle, RayLanes rays, double tolerance) const override {
    RayRanges parts;
    const RayLanes in_cell = clip_to_cell(cell, bundle, rays, parts);
    RayRanges::Column limits;
    limits.fill(std::numeric_limits<double>::infinity());
    std::array<SurfacePoint, RayBundle::kWidth> found;
    return Search{*model_, primitives_of(cells_[cell]), bundle, limits, tolerance, true, found}.run(in_cell, parts);
  }

 private:
  // The cylinder, in single precision and so a little larger, and the primitives that matter in it.
  struct Cell {
    std::array<float, 3> center, axis;
    float half_length, radius;
    std::uint64_t first : 40, count : 24;

    Cell(const CellPlan& plan, std::size_t offset)
        : first((offset + plan.first) & ((std::uint64_t{1} << 40) - 1)), count(plan.count & 0xffffff) {
      const Cylinder& c = plan.cylinder;
      const double off = 0x1p-22 * (glm::length(c.center) + c.half_length + c.radius);
      for (int k = 0; k < 3; ++k) {
        center[static_cast<std::size_t>(k)] = static_cast<float>(c.center[k]);
        axis[static_cast<std::size_t>(k)] = static_cast<float>(c.axis[k]);
      }
      half_length = static_cast<float>(c.half_length + off);
      radius = static_cast<float>(c.radius + off);
    }

    Cylinder cylinder() const {
      return {{center[0], center[1], center[2]}, {axis[0], axis[1], axis[2]}, half_length, radius};
    }
  };

  void unite(const std::vector<Plan>& plans) {
    std::size_t cells = 0, primitives = 0;
    for (const Plan& plan : plans) cells += plan.cells.size(), primitives += plan.primitives.size();
    reserve_large(cells_, cells);
    reserve_large(primitives_, primitives);
    for (const Plan& plan : plans) {
      for (const CellPlan& cell : plan.cells) cells_.emplace_back(cell, primitives_.size());
      primitives_.insert(primitives_.end(), plan.primitives.begin(), plan.primitives.end());
    }
  }

  RayLanes clip_to_cell(std::size_t cell, const RayBundle& bundle, RayLanes rays, RayRanges& parts) const {
    RayLanes in_cell = clip(bundle, rays, cells_[cell].cylinder(), parts);
    if (!is_part_) return in_cell;
    for_each_lane(in_cell, [&](std::size_t lane) {
      parts.set(lane, clip(bundle.ray(lane), region_, parts[lane]));
      if (parts[lane].empty()) in_cell &= ~(RayLanes{1} << lane);
    });
    return in_cell;
  }

  std::span<const std::uint32_t> primitives_of(const Cell& cell) const {
    return std::span(primitives_).subspan(cell.first, cell.count);
  }

  ModelPtr model_;
  Box region_;
  bool is_part_ = false;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> primitives_;
};

}  // namespace

std::unique_ptr<const SurfaceCells> cells_of(ModelPtr model, const Box& region) {
  return std::make_unique<ModelCells>(std::move(model), region);
}

}  // namespace barkridge
