#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "blobtree/falloff.h"
#include "blobtree/field_model.h"
#include "blobtree/primitive_bounds.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

// No operator makes more of its operands than their sum. So where the field reaches the iso-value and k primitives
// matter, one of them has at least the k-th part of it: the point is within that one's level of this normalised
// distance.
constexpr std::size_t kMostCounted = 16;

std::array<double, kMostCounted + 1> level_distances() {
  std::array<double, kMostCounted + 1> distances{};
  for (std::size_t k = 1; k <= kMostCounted; ++k) {
    double lo = 0, hi = 1;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (lo + hi);
      (falloff(middle * middle) < kIsoValue / static_cast<double>(k) ? hi : lo) = middle;
    }
    distances[k] = hi * (1 + 1e-5);
  }
  return distances;
}

// The part of a cone's support in which it is not zero, in scene units.
struct Tube {
  Vec3 base, axis;
  double base_radius, taper, length;
  Interval along;
  bool free_base, free_tip;
  bool is_limited;  // whether a limit of the radius is at work

  // The surface of the level u between two places lies within this distance of the axis.
  double reach(double u, double from, double to) const {
    if (free_base) from = std::clamp(from, 0.0, length), to = std::max(to, 0.0);
    if (free_tip) to = std::clamp(to, 0.0, length), from = std::min(from, length);
    const double radius = base_radius + std::max(taper * from, taper * to);
    return 2 * u * radius / std::sqrt(1 - 4 * u * u * taper * taper);
  }
  // In the world, or in a frame.
  Box box(double u, double from, double to, const Warp::Framed* frame) const {
    const double radius = reach(u, from, to);
    const Vec3 start = frame ? frame->to_local(base) : base,
               along_axis = frame ? frame->to_local(base + axis) - start : axis;
    return unite(disc_box(start + from * along_axis, along_axis, radius),
                 disc_box(start + to * along_axis, along_axis, radius));
  }
};

Tube tube_of(const ConeRecord& c, ConeKind kind, double scale) {
  Tube tube{c.base, Vec3(c.axis),      c.base_radius / scale, c.taper, c.length / scale,
            {},     c.has_free_base(), c.has_free_tip(),      false};
  const double r0 = tube.base_radius, r1 = c.tip_radius() / scale;
  tube.along = {tube.free_base ? -2 * r0 : c.rise_start / scale,
                tube.free_tip ? tube.length + 2 * r1 : (c.fall_start + 1 / c.fall_scale) / scale};
  const double steep = 4 * c.taper * c.taper;
  const double at_lo = r0 + c.taper * std::min(0.0, tube.along.lo),
               at_hi = r0 + c.taper * std::max(tube.length, tube.along.hi);
  const double lowest = 0.5 * std::min(r0, r1), highest = 2 * std::max(r0, r1) * (1 - steep);
  tube.is_limited = steep > 0.5 ||
                    (kind == ConeKind::kFaded && (std::min(at_lo, at_hi) < lowest || std::max(at_lo, at_hi) > highest));
  return tube;
}

// Boxes of long slanting tubes are mostly empty: shorter pieces fit.
int piece_count(const Tube& tube) {
  constexpr double kLongest = 5;  // radii
  constexpr double kMostPieces = 8;
  Vec3 extent = glm::abs(tube.axis) * (tube.along.hi - tube.along.lo);
  std::sort(&extent.x, &extent.x + 3);
  return static_cast<int>(std::clamp(std::ceil(extent.y / (kLongest * tube.base_radius)), 1.0, kMostPieces));
}

class Cover {
 public:
  explicit Cover(const FieldModel& model) : model_(model) {}

  std::vector<Box> run() const {
    constexpr std::size_t kChunk = 1024;
    const std::size_t count = model_.cones.size();
    std::vector<std::vector<Box>> chunks((count + kChunk - 1) / kChunk);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
      for (std::size_t p = i * kChunk; p < std::min(count, (i + 1) * kChunk); ++p) {
        cover(static_cast<std::uint32_t>(p), chunks[i]);
      }
    });
    std::vector<Box> boxes;
    for (const std::vector<Box>& chunk : chunks) boxes.insert(boxes.end(), chunk.begin(), chunk.end());
    return boxes;
  }

 private:
  void cover(std::uint32_t primitive, std::vector<Box>& boxes) const {
    const std::uint32_t sum = model_.sums[primitive];
    if (only_takes_away(sum)) return;
    if (model_.other_at(primitive)) {
      boxes.push_back(intersect(model_.supports.box(primitive), model_.support));
      return;
    }
    const Tube tube = tube_of(model_.cones[primitive], model_.kinds[primitive], model_.units.scale);
    if (tube.along.empty()) return;
    if (tube.is_limited) {
      boxes.push_back(intersect(model_.supports.box(primitive), model_.support));
      return;
    }
    const int pieces = piece_count(tube);
    const double step = (tube.along.hi - tube.along.lo) / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double from = tube.along.lo + i * step, to = i + 1 < pieces ? from + step : tube.along.hi;
      const auto box_of_level = [&](double u) {
        return box_in_world(model_, sum, [&](const Warp::Framed* frame) { return tube.box(u, from, to, frame); });
      };
      const Box support = intersect(box_of_level(1), model_.support);
      static const std::array<double, kMostCounted + 1> kDistances = level_distances();
      const std::size_t count = count_in(support);
      const double u = count <= kMostCounted ? kDistances[std::max<std::size_t>(1, count)] : 1;
      const Box box = u < 1 ? intersect(support, box_of_level(u)) : support;
      if (!box.empty()) boxes.push_back(box);
    }
  }

  std::size_t count_in(const Box& box) const {
    thread_local std::vector<std::uint32_t> found;
    found.clear();
    return model_.supports.find(box, kMostCounted, found) ? found.size() : kMostCounted + 1;
  }

  bool only_takes_away(std::uint32_t sum) const {
    const FieldOperator* node = &model_.operators[sum];
    bool takes_away = false;
    while (node->kept_above != kNoOperator) {
      const FieldOperator& above = model_.operators[node->kept_above];
      if (above.op == Op::kNegate || (above.op == Op::kDifference && node->kept_rank == 1)) takes_away = !takes_away;
      node = &above;
    }
    return takes_away;
  }

  const FieldModel& model_;
};

}  // namespace

std::vector<Box> cover_of(const FieldModel& model) { return Cover(model).run(); }

}  // namespace barkridge
