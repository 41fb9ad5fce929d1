#include "blobtree/line_cones.h"

#include <algorithm>
#include <cmath>

#include "blobtree/line_kernels.h"
#include "blobtree/tube.h"

namespace barkridge {

namespace {

constexpr double kRounding = 1e-5;

void place_base(const Vec3& base, std::size_t lane, ConeColumns& columns) {
  for (int k = 0; k < 3; ++k) columns.base[static_cast<std::size_t>(k)][lane] = static_cast<float>(base[k]);
}

void place(const ConeRecord& c, ConeKind kind, const Vec3& origin, const ModelUnits& units, std::size_t lane,
           ConeColumns& columns) {
  place_base(units.scale * (c.base - origin), lane, columns);
  for (int k = 0; k < 3; ++k) columns.axis[static_cast<std::size_t>(k)][lane] = c.axis[k];
  columns.base_radius[lane] = c.base_radius;
  columns.taper[lane] = c.taper;
  columns.length[lane] = c.length;
  columns.rise_start[lane] = c.rise_start;
  columns.rise_scale[lane] = c.rise_scale;
  columns.fall_start[lane] = c.fall_start;
  columns.fall_scale[lane] = c.fall_scale;
  columns.is_plain[lane] = kind == ConeKind::kPlain ? 1 : 0;
  columns.limited_slope[lane] = kind == ConeKind::kLimited ? static_cast<float>(limited_slope(c)) : 0;
  columns.is_unknown[lane] = 0;
}

// A cylinder that holds all of a warped cone's field; how strong it is there is not known.
void place(const Cylinder& cylinder, const Vec3& origin, const ModelUnits& units, std::size_t lane,
           ConeColumns& columns) {
  const double margin = kRounding * (cylinder.half_length + cylinder.radius);
  const double half_length = cylinder.half_length + margin, radius = cylinder.radius + margin;
  place_base(units.scale * (cylinder.center - half_length * cylinder.axis - origin), lane, columns);
  for (int k = 0; k < 3; ++k) {
    columns.axis[static_cast<std::size_t>(k)][lane] = static_cast<float>(cylinder.axis[k]);
  }
  const auto length = static_cast<float>(2 * units.scale * half_length);
  columns.base_radius[lane] = static_cast<float>(0.5 * units.scale * radius);
  columns.taper[lane] = 0;
  columns.length[lane] = length;
  columns.rise_start[lane] = 0;
  columns.rise_scale[lane] = 1;
  columns.fall_start[lane] = length;
  columns.fall_scale[lane] = 1e30f;
  columns.is_plain[lane] = 0;
  columns.limited_slope[lane] = 1e15f;
  columns.is_unknown[lane] = 1;
}

ConeBounds bounds_at(const ConesMet& met, std::size_t lane, double scale) {
  const auto unit = [](float x) { return static_cast<double>(x); };
  return {{{0, unit(met.highest[lane])},
           scale * unit(met.slope[lane]),
           {scale * scale * unit(met.least_second[lane]), scale * scale * unit(met.most_second[lane])}},
          (met.steady >> lane & 1) != 0};
}

}  // namespace

void meet(const FieldModel& model, std::span<const Cylinder> supports, std::span<const std::uint32_t> primitives,
          const Ray& ray, const Interval& range, LineMeeting& meeting) {
  meeting.primitives.clear();
  meeting.cones.clear();
  const double middle = 0.5 * (range.lo + range.hi), scale = model.units.scale;
  const Vec3 origin = ray.at(middle);
  const auto half = static_cast<float>(0.5 * scale * (range.hi - range.lo));
  LineReach reach{half, -half};
  double highest_sum = 0;
  bool are_all_cones = true;
  ConeColumns columns;
  ConesMet met;
  std::array<std::uint32_t, ConeColumns::kWidth> numbers;
  for (std::size_t next = 0; next < primitives.size();) {
    std::size_t count = 0;
    unsigned adding = 0;
    for (; next < primitives.size() && count < ConeColumns::kWidth; ++next, ++count) {
      const std::uint32_t number = primitives[next], sum = model.sums[number];
      if (model.other_at(number)) break;
      numbers[count] = number;
      if (is_warped(model, sum)) {
        place(supports[number], origin, model.units, count, columns);
      } else {
        place(model.cones[number], model.kinds[number], origin, model.units, count, columns);
      }
      if (!model.takes_away || !only_takes_away(model, sum)) adding |= 1u << count;
    }
    if (count > 0) {
      meet_cones(columns, count, ray.direction, half, met);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if ((met.met >> lane & 1) == 0) continue;
        meeting.primitives.push_back(numbers[lane]);
        meeting.cones.push_back(bounds_at(met, lane, scale));
        if ((adding >> lane & 1) == 0) continue;
        highest_sum += static_cast<double>(met.highest[lane]);
        reach.lo = std::min(reach.lo, met.lo[lane]);
        reach.hi = std::max(reach.hi, met.hi[lane]);
      }
    }
    if (next < primitives.size() && model.other_at(primitives[next])) {
      meeting.primitives.push_back(primitives[next++]);
      are_all_cones = false;
    }
  }
  if (are_all_cones) {
    // No reach grows beyond the range by rounding.
    meeting.reach.lo = reach.lo <= -half ? range.lo : middle + static_cast<double>(reach.lo) / scale;
    meeting.reach.hi = reach.hi >= half ? range.hi : middle + static_cast<double>(reach.hi) / scale;
    if (highest_sum == 0) meeting.reach = {};
    meeting.highest_sum = highest_sum * (1 + kRounding);
  } else {
    meeting.reach = range;
    meeting.highest_sum = std::numeric_limits<double>::infinity();
  }
}

}  // namespace barkridge
