#include "blobtree/line_cones.h"

#include <algorithm>
#include <array>
#include <limits>

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

void place(const ConeRecord& c, ConeKind kind, const Piece& piece, const ModelUnits& units, std::size_t lane,
           ConeColumns& columns) {
  const Vec3 base = units.scale * (c.base - piece.middle);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    columns.base[axis][lane] = static_cast<float>(base[k]);
    columns.axis[axis][lane] = c.axis[k];
    columns.direction[axis][lane] = static_cast<float>(piece.direction[k]);
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
  columns.half[lane] = static_cast<float>(units.scale * piece.half);
  columns.slack[lane] = static_cast<float>(std::min(units.scale * piece.slack, 1e15));
}

// The only warp above a sum; nothing if there are more.
const Warp* only_warp(const FieldModel& model, std::uint32_t sum) {
  const Warp* warp = nullptr;
  for (std::uint32_t at = model.operators[sum].kept_above; at != kNoOperator; at = model.operators[at].kept_above) {
    if (model.operators[at].op != FieldInstruction::Op::kEnterWarp) continue;
    if (warp) return nullptr;
    warp = &model.warps[model.operators[at].index];
  }
  return warp;
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

ConeBounds bounds_at(const ConesMet& met, std::size_t lane, double scale) {
  const auto unit = [](float x) { return static_cast<double>(x); };
  return {{{0, unit(met.highest[lane])},
           scale * unit(met.slope[lane]),
           {scale * scale * unit(met.least_second[lane]), scale * scale * unit(met.most_second[lane])}},
          (met.steady >> lane & 1) != 0};
}

// Of a cone under several warps, from a box around the piece.
ConeBounds bounds_in_box(const FieldModel& model, std::uint32_t number, const Ray& ray, const Interval& range) {
  std::vector<std::uint32_t> warps;  // from the innermost on
  for (std::uint32_t at = model.operators[model.sums[number]].kept_above; at != kNoOperator;
       at = model.operators[at].kept_above) {
    if (model.operators[at].op == FieldInstruction::Op::kEnterWarp) warps.push_back(model.operators[at].index);
  }
  const Vec3 a = ray.at(range.lo), b = ray.at(range.hi);
  Box box{glm::min(a, b), glm::max(a, b)};
  double stretch = 1;
  for (std::size_t i = warps.size(); i-- > 0;) {
    const WarpedBox warped = model.warps[warps[i]].map(box);
    box = warped.box;
    stretch *= warped.stretch;
  }
  ConeBounds bounds = bounds_of(model.cones[number], model.kinds[number], model.units, box);
  bounds.field.slope *= stretch;
  bounds.field.second = FieldBounds{}.second;
  return bounds;
}

}  // namespace

void meet(const FieldModel& model, std::span<const std::uint32_t> primitives, const Ray& ray, const Interval& range,
          LineMeeting& meeting) {
  meeting.primitives.clear();
  meeting.cones.clear();
  meeting.reach = {};
  meeting.highest_sum = 0;
  const double scale = model.units.scale, length = range.hi - range.lo, middle = 0.5 * (range.lo + range.hi);
  const Piece straight{ray.at(middle), ray.direction, 0.5 * length, 0};
  const auto keep = [&](std::uint32_t number, const ConeBounds& bounds, const Interval& reach) {
    meeting.primitives.push_back(number);
    meeting.cones.push_back(bounds);
    const std::uint32_t sum = model.sums[number];
    if (model.takes_away && only_takes_away(model, sum)) return;
    meeting.highest_sum += static_cast<double>(model.operators[sum].gain) * bounds.field.value.hi;
    meeting.reach = {std::min(meeting.reach.lo, reach.lo), std::max(meeting.reach.hi, reach.hi)};
  };
  bool are_all_cones = true;
  ConeColumns columns;
  ConesMet met;
  std::array<std::uint32_t, ConeColumns::kWidth> numbers;
  std::array<WarpedPiece, ConeColumns::kWidth> warped;
  for (std::size_t next = 0; next < primitives.size();) {
    // Cones go side by side, up to a primitive of another kind or one under several warps.
    std::size_t count = 0;
    unsigned bent = 0;
    for (; next < primitives.size() && count < ConeColumns::kWidth; ++next, ++count) {
      const std::uint32_t number = primitives[next], sum = model.sums[number];
      if (model.other_at(number)) break;
      numbers[count] = number;
      if (!is_warped(model, sum)) {
        place(model.cones[number], model.kinds[number], straight, model.units, count, columns);
        continue;
      }
      const Warp* warp = only_warp(model, sum);
      if (!warp) break;
      warped[count] = warp->map(ray.at(range.lo), ray.at(range.hi));
      place(model.cones[number], model.kinds[number], chord_of(warped[count], length), model.units, count, columns);
      bent |= 1u << count;
    }
    if (count > 0) meet_cones(columns, count, met);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if ((met.met >> lane & 1) == 0) continue;
      ConeBounds bounds = bounds_at(met, lane, scale);
      if ((bent >> lane & 1) != 0) {
        bounds.field = through_warp(bounds.field, warped[lane].stretch, warped[lane].curvature, warped[lane].jump);
      }
      // In shares of the piece: a curve is near its chord where it has come as far. No reach grows beyond the range.
      const double half = static_cast<double>(columns.half[lane]);
      const auto share = [&](float at) { return half > 0 ? static_cast<double>(at) / half : 0; };
      const double lo = share(met.lo[lane]), hi = share(met.hi[lane]);
      keep(numbers[lane], bounds,
           {lo <= -1 ? range.lo : middle + 0.5 * lo * length, hi >= 1 ? range.hi : middle + 0.5 * hi * length});
    }
    if (count == ConeColumns::kWidth || next == primitives.size()) continue;
    const std::uint32_t number = primitives[next++];
    if (model.other_at(number)) {
      meeting.primitives.push_back(number);
      are_all_cones = false;
    } else if (const ConeBounds bounds = bounds_in_box(model, number, ray, range); bounds.field.value.hi > 0) {
      keep(number, bounds, range);
    }
  }
  if (!are_all_cones) {
    meeting.reach = range;
    meeting.highest_sum = std::numeric_limits<double>::infinity();
  }
  meeting.highest_sum *= 1 + kRounding;
}

}  // namespace barkridge
