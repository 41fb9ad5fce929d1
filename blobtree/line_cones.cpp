#include "blobtree/line_cones.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include "blobtree/bend_kernels.h"
#include "blobtree/line_kernels.h"
#include "blobtree/operator_bounds.h"

namespace barkridge {

namespace {

constexpr double kRounding = 1e-5;

// A straight piece, and how near to it what is met stays, point by point. In scene units.
struct Piece {
  Vec3 middle{0}, direction{0, 0, 1};
  double half = 0;
  double slack = 0;
};

Piece straight_piece(const Ray& ray, const Interval& range) {
  return {ray.at(0.5 * (range.lo + range.hi)), ray.direction, 0.5 * (range.hi - range.lo), 0};
}

// Under a warp a ray's piece is a curve, which stays near the chord of its ends. [docs/field.md, "Bend"]
Piece chord_of(const WarpedPiece& warped, double length) {
  const double chord = glm::distance(warped.from, warped.to);
  Piece piece;
  piece.middle = 0.5 * (warped.from + warped.to);
  if (chord > 0) piece.direction = (warped.to - warped.from) / chord;
  piece.half = 0.5 * chord;
  if (length > 0) piece.slack = length * (0.25 * warped.jump + 0.125 * warped.curvature * length);
  return piece;
}

void place(const ConeRecord& c, ConeKind kind, const Vec3& origin, const ModelUnits& units, std::size_t lane,
           ConeColumns& columns) {
  const Vec3 base = units.scale * (c.base - origin);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    columns.base[axis][lane] = static_cast<float>(base[k]);
    columns.axis[axis][lane] = c.axis[k];
  }
  columns.base_radius[lane] = c.base_radius;
  columns.taper[lane] = c.taper;
  columns.length[lane] = c.length;
  columns.rise_start[lane] = c.rise_start;
  columns.rise_scale[lane] = c.rise_scale;
  columns.fall_start[lane] = c.fall_start;
  columns.fall_scale[lane] = c.fall_scale;
  columns.is_plain[lane] = kind == ConeKind::kPlain ? 1 : 0;
  columns.limited_slope[lane] = kind == ConeKind::kLimited ? static_cast<float>(limited_slope(c)) : 0;
}

void place(const Piece& piece, const Vec3& origin, const ModelUnits& units, std::size_t lane, LineColumns& columns) {
  const Vec3 middle = units.scale * (piece.middle - origin);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    columns.middle[axis][lane] = static_cast<float>(middle[k]);
    columns.direction[axis][lane] = static_cast<float>(piece.direction[k]);
  }
  columns.half[lane] = static_cast<float>(units.scale * piece.half);
  columns.slack[lane] = static_cast<float>(std::min(units.scale * piece.slack, 1e15));
}

// Of a cone under several warps, from a box around the pieces.
FieldBounds bounds_in_box(const FieldModel& model, std::uint32_t number, Box box) {
  std::vector<std::uint32_t> warps;  // from the innermost on
  for (std::uint32_t at = model.operators[model.sum_of(number)].kept_above; at != kNoOperator;
       at = model.operators[at].kept_above) {
    if (model.operators[at].op == FieldInstruction::Op::kEnterWarp) warps.push_back(model.operators[at].index);
  }
  double stretch = 1;
  for (std::size_t i = warps.size(); i-- > 0;) {
    const WarpedBox warped = model.warps[warps[i]].map(box);
    box = warped.box;
    stretch *= warped.stretch;
  }
  FieldBounds bounds = bounds_of(model.cones[number], model.kinds[number], model.units, box).field;
  bounds.slope *= stretch;
  bounds.second = FieldBounds{}.second;
  return bounds;
}

// What stands above a primitive, as far as it matters to how lines meet it.
enum class Above { kNothing, kOneWarp, kWarps };

struct Surroundings {
  Above above = Above::kNothing;
  const Warp* warp = nullptr;  // if it is one
};

Surroundings surroundings_of(const FieldModel& model, std::uint32_t primitive) {
  Surroundings found;
  if (model.warps.empty()) return found;
  const std::uint32_t sum = model.sum_of(primitive);
  for (std::uint32_t at = model.operators[sum].kept_above; at != kNoOperator; at = model.operators[at].kept_above) {
    if (model.operators[at].op != FieldInstruction::Op::kEnterWarp) continue;
    if (found.warp) return {Above::kWarps, nullptr};
    found = {Above::kOneWarp, &model.warps[model.operators[at].index]};
  }
  return found;
}

// What the rays meet of one primitive, by their lanes in the bundle; and, of lines under a warp, the most of all.
struct Met : ConesMet {
  double stretch, curvature, jump;
  bool is_warped;
  FieldBounds in_box;  // for a cone under several warps all that is known
  enum class What { kCone, kConeInBox, kOther } what;

  void reset(What kind) {
    met = steady = 0;
    stretch = 1;
    curvature = jump = 0;
    is_warped = false;
    what = kind;
  }
};

// The lines that some rays are under a warp.
struct WarpedLines {
  BentPieces pieces;
  const Warp* warp = nullptr;
  Vec3 origin{0};
  double stretch = 1, curvature = 0, jump = 0;  // the most of all
};

class Meeter {
 public:
  Meeter(const FieldModel& model, std::span<const std::uint32_t> primitives, const RayBundle& bundle, RayLanes rays,
         const RayRanges& ranges)
      : model_(model), primitives_(primitives), bundle_(bundle), rays_(rays), ranges_(ranges), met_(memory()) {
    if (met_.size() < primitives.size()) met_.resize(primitives.size());
  }

  void run(LineMeeting& meeting) {
    // By whichever takes fewer calls: a ray with many cones, or a cone with many rays, which is placed but once. Under
    // warps a ray is another line for every cone.
    const auto rays = static_cast<std::size_t>(std::popcount(rays_));
    if (model_.warps.empty() && 2 * rays * ((primitives_.size() + kWidth - 1) / kWidth) <= primitives_.size() + 1) {
      meet_by_ray();
    } else {
      meet_by_cone();
    }
    find_reach(meeting);
    collect(meeting);
  }

 private:
  static constexpr std::size_t kWidth = ConeColumns::kWidth;
  static_assert(kWidth == RayBundle::kWidth);

  static std::vector<Met>& memory() {
    thread_local std::vector<Met> met;
    return met;
  }

  std::size_t lane_count() const { return static_cast<std::size_t>(std::bit_width(rays_)); }

  // What no kernel meets is met by all.
  bool is_met_by_kernels(std::size_t i, const Surroundings& around) {
    const std::uint32_t number = primitives_[i];
    met_[i].reset(model_.other_at(number) ? Met::What::kOther : Met::What::kCone);
    if (met_[i].what == Met::What::kCone && around.above != Above::kWarps) return true;
    met_[i].met = rays_;
    if (met_[i].what == Met::What::kOther) return false;
    met_[i].what = Met::What::kConeInBox;
    met_[i].in_box = bounds_in_box(model_, number, box_around(rays_));
    if (met_[i].in_box.value.hi <= 0) met_[i].met = 0;
    return false;
  }

  Box box_around(RayLanes rays) const {
    Box box;
    for_each_lane(rays, [&](std::size_t lane) {
      const Ray ray = bundle_.ray(lane);
      box = unite(unite(box, ray.at(ranges_.lo[lane])), ray.at(ranges_.hi[lane]));
    });
    return box;
  }

  void meet_by_cone() {
    const auto first = static_cast<std::size_t>(std::countr_zero(rays_));
    const Vec3 origin = straight_piece(bundle_.ray(first), ranges_[first]).middle;
    LineColumns straight{};
    for_each_lane(rays_, [&](std::size_t lane) {
      place(straight_piece(bundle_.ray(lane), ranges_[lane]), origin, model_.units, lane, straight);
    });
    const PieceColumns pieces = model_.warps.empty() ? PieceColumns{} : pieces_about(origin);
    const Box all_parts = model_.warps.empty() ? Box{} : box_around(rays_);
    WarpedLines warped;
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      const std::uint32_t number = primitives_[i];
      const Surroundings around = surroundings_of(model_, number);
      if (!is_met_by_kernels(i, around)) continue;
      // Most of what is bent is far from the rays, and boxes tell that sooner than a bend.
      if (around.warp && !model_.supports.box(number).overlaps(all_parts)) continue;
      if (around.warp && around.warp != warped.warp) warp_lines(*around.warp, pieces, warped);
      place(model_.cones[number], model_.kinds[number], around.warp ? warped.origin : origin, model_.units, 0,
            columns_);
      meet_first_cone(columns_, around.warp ? warped.pieces.chords : straight, lane_count(), met_[i]);
      met_[i].met &= rays_;
      if (!around.warp) continue;
      met_[i].is_warped = true;
      met_[i].stretch = warped.stretch;
      met_[i].curvature = warped.curvature;
      met_[i].jump = warped.jump;
    }
  }

  void warp_lines(const Warp& warp, const PieceColumns& pieces, WarpedLines& warped) const {
    warped.warp = &warp;
    warped.stretch = 1;
    warped.curvature = warped.jump = 0;
    if (const Warp::BendData* bend = warp.bend()) {
      bend_lines(*bend, pieces, warped);
    } else {
      map_lines(warp, warped);
    }
  }

  PieceColumns pieces_about(const Vec3& origin) const {
    const double scale = model_.units.scale;
    PieceColumns pieces{};
    pieces.origin = origin;
    for_each_lane(rays_, [&](std::size_t lane) {
      const Ray ray = bundle_.ray(lane);
      const Vec3 from = scale * (ray.at(ranges_.lo[lane]) - origin), to = scale * (ray.at(ranges_.hi[lane]) - origin);
      for (int k = 0; k < 3; ++k) {
        pieces.from[static_cast<std::size_t>(k)][lane] = static_cast<float>(from[k]);
        pieces.to[static_cast<std::size_t>(k)][lane] = static_cast<float>(to[k]);
      }
    });
    return pieces;
  }

  void bend_lines(const Warp::BendData& bend, const PieceColumns& pieces, WarpedLines& warped) const {
    const double scale = model_.units.scale;
    BentPieces& bent = warped.pieces;
    bend_pieces(bend, scale, pieces, lane_count(), bent);
    warped.origin = bend.straight_middle();
    const auto most = [&](const ConeColumns::Column& column) {
      float largest = 0;
      for_each_lane(rays_, [&](std::size_t lane) { largest = std::max(largest, column[lane]); });
      return static_cast<double>(largest);
    };
    warped.stretch = most(bent.stretch);
    warped.curvature = scale * most(bent.curvature);
    warped.jump = most(bent.jump);
  }

  void map_lines(const Warp& warp, WarpedLines& warped) const {
    warped.pieces.chords = {};
    bool is_first = true;
    for_each_lane(rays_, [&](std::size_t lane) {
      const Ray ray = bundle_.ray(lane);
      const WarpedPiece piece = warp.map(ray.at(ranges_.lo[lane]), ray.at(ranges_.hi[lane]));
      const Piece chord = chord_of(piece, ranges_.hi[lane] - ranges_.lo[lane]);
      if (is_first) warped.origin = chord.middle;
      is_first = false;
      place(chord, warped.origin, model_.units, lane, warped.pieces.chords);
      warped.stretch = std::max(warped.stretch, piece.stretch);
      warped.curvature = std::max(warped.curvature, piece.curvature);
      warped.jump = std::max(warped.jump, piece.jump);
    });
  }

  void meet_by_ray() {
    candidates_.clear();
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      if (is_met_by_kernels(i, {})) candidates_.push_back(i);
    }
    for_each_lane(rays_, [&](std::size_t ray) {
      for (std::size_t start = 0; start < candidates_.size(); start += kWidth) {
        meet_some(ray, std::span(candidates_).subspan(start, std::min(kWidth, candidates_.size() - start)));
      }
    });
  }

  void meet_some(std::size_t ray, std::span<const std::size_t> some) {
    const Piece piece = straight_piece(bundle_.ray(ray), ranges_[ray]);
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      const std::uint32_t number = primitives_[some[lane]];
      place(model_.cones[number], model_.kinds[number], piece.middle, model_.units, lane, columns_);
      place(piece, piece.middle, model_.units, lane, lines_);
    }
    ConesMet result;
    meet_cones(columns_, lines_, some.size(), result);
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      Met& met = met_[some[lane]];
      met.steady |= (result.steady >> lane & 1) << ray;
      if ((result.met >> lane & 1) == 0) continue;
      met.met |= RayLanes{1} << ray;
      met.lo[ray] = result.lo[lane];
      met.hi[ray] = result.hi[lane];
      met.highest[ray] = result.highest[lane];
      met.slope[ray] = result.slope[lane];
      met.least_second[ray] = result.least_second[lane];
      met.most_second[ray] = result.most_second[lane];
    }
  }

  // Where the primitives that can add something do, and how much.
  void find_reach(LineMeeting& meeting) {
    RayRanges::Column highest{}, lo, hi;  // shares of half the range, from its middle on
    lo.fill(std::numeric_limits<double>::infinity());
    hi.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      const Met& met = met_[i];
      if (met.met == 0) continue;
      const std::uint32_t sum = model_.sum_of(primitives_[i]);
      if (model_.takes_away && only_takes_away(model_, sum)) continue;
      const auto gain = static_cast<double>(model_.operators[sum].gain);
      for_each_lane(met.met, [&](std::size_t lane) {
        if (met.what == Met::What::kCone) {
          highest[lane] += gain * static_cast<double>(met.highest[lane]);
          lo[lane] = std::min(lo[lane], static_cast<double>(met.lo[lane]));
          hi[lane] = std::max(hi[lane], static_cast<double>(met.hi[lane]));
        } else {
          const bool is_bounded = met.what == Met::What::kConeInBox;
          highest[lane] += is_bounded ? gain * met.in_box.value.hi : std::numeric_limits<double>::infinity();
          lo[lane] = -1;
          hi[lane] = 1;
        }
      });
    }
    meeting.rays = 0;
    for_each_lane(rays_, [&](std::size_t lane) {
      if (lo[lane] > hi[lane] || (model_.is_below_sum && highest[lane] * (1 + kRounding) < kIsoValue)) return;
      meeting.rays |= RayLanes{1} << lane;
      // A curve is near its chord where it has come as far. No reach grows beyond the range.
      const Interval range = ranges_[lane];
      const double middle = 0.5 * (range.lo + range.hi), half = 0.5 * (range.hi - range.lo);
      meeting.reach.set(lane, {lo[lane] <= -1 ? range.lo : middle + lo[lane] * half,
                               hi[lane] >= 1 ? range.hi : middle + hi[lane] * half});
    });
  }

  void collect(LineMeeting& meeting) const {
    meeting.primitives.clear();
    meeting.cones.clear();
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      const RayLanes rays = met_[i].met & meeting.rays;
      if (rays == 0) continue;
      meeting.primitives.push_back(primitives_[i]);
      meeting.cones.push_back(met_[i].what == Met::What::kOther       ? ConeBounds{}
                              : met_[i].what == Met::What::kConeInBox ? ConeBounds{met_[i].in_box, false}
                                                                      : bounds_of_cone(met_[i], rays, meeting.rays));
    }
  }

  // On the ranges of all rays, also those that do not meet it.
  ConeBounds bounds_of_cone(const Met& met, RayLanes rays, RayLanes all) const {
    float highest = 0, slope = 0, least_second = 0, most_second = 0;
    for_each_lane(rays, [&](std::size_t lane) {
      highest = std::max(highest, met.highest[lane]);
      slope = std::max(slope, met.slope[lane]);
      least_second = std::min(least_second, met.least_second[lane]);
      most_second = std::max(most_second, met.most_second[lane]);
    });
    const double scale = model_.units.scale;
    const auto unit = [](float x) { return static_cast<double>(x); };
    const FieldBounds bounds{{0, unit(highest)},
                             scale * unit(slope),
                             {scale * scale * unit(least_second), scale * scale * unit(most_second)}};
    return {met.is_warped ? through_warp(bounds, met.stretch, met.curvature, met.jump) : bounds,
            (met.steady & all) == all};
  }

  static std::vector<std::size_t>& candidate_memory() {
    thread_local std::vector<std::size_t> candidates;
    return candidates;
  }

  const FieldModel& model_;
  std::span<const std::uint32_t> primitives_;
  const RayBundle& bundle_;
  RayLanes rays_;
  const RayRanges& ranges_;
  std::vector<Met>& met_;
  ConeColumns columns_;
  LineColumns lines_;
  std::vector<std::size_t>& candidates_ = candidate_memory();
};

}  // namespace

void meet(const FieldModel& model, std::span<const std::uint32_t> primitives, const RayBundle& bundle, RayLanes rays,
          const RayRanges& ranges, LineMeeting& meeting) {
  Meeter(model, primitives, bundle, rays, ranges).run(meeting);
}

}  // namespace barkridge
