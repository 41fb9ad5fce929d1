#pragma once
// A cone and the levels of its field as cylinders around it.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "blobtree/cylinder.h"
#include "blobtree/field_model.h"

namespace barkridge {

/// The part of a cone's support in which it is not zero, in scene units.
struct Tube {
  Vec3 base, axis;
  double base_radius, taper, length;
  Interval along;
  bool free_base, free_tip;
  double lateral;   ///< no level is wider
  bool has_levels;  ///< not where limits of the radius may be at work: then levels are not told apart

  double radius_at(double y) const {
    return base_radius + taper * std::clamp(y, free_base ? 0 : y, free_tip ? length : y);
  }

  /// The places beside which the level u can be, between two others.
  Interval part(double u, double from, double to) const {
    if (has_levels && free_base) from = std::max(from, -2 * u * base_radius);
    if (has_levels && free_tip) to = std::min(to, length + 2 * u * (base_radius + taper * length));
    return {from, to};
  }
  /// The level lies within this distance of the axis there.
  double reach(double u, const Interval& part) const {
    if (!has_levels) return lateral;
    const double radius = std::max(radius_at(part.lo), radius_at(part.hi));
    return std::min(lateral, 2 * u * radius / std::sqrt(1 - 4 * u * u * taper * taper));
  }
};
/// `scale` is that of the record's units.
Tube tube_of(const ConeRecord& cone, ConeKind kind, double scale);

/// The part of a tube's level u between two places, moved by the warps above its sum; nothing where the level is not.
std::optional<Cylinder> cylinder_of(const FieldModel& model, std::uint32_t sum, const Tube& tube, double u, double from,
                                    double to);

/// Cylinders that hold the supports of all primitives, in scene units.
std::vector<Cylinder> support_cylinders(const FieldModel& model);

}  // namespace barkridge
