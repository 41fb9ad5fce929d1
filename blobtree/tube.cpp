#include "blobtree/tube.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/large_room.h"

namespace barkridge {

Tube tube_of(const ConeRecord& c, ConeKind kind, double scale) {
  const ConeSupport support = support_of(c, kind);
  return {c.base,
          Vec3(c.axis),
          c.base_radius / scale,
          c.taper,
          c.length / scale,
          {support.along.lo / scale, support.along.hi / scale},
          c.has_free_base(),
          c.has_free_tip(),
          support.lateral / scale,
          kind != ConeKind::kLimited && 8 * c.taper * c.taper <= 1};
}

namespace {

// Around a part of a bend's axis with all that is within `radius` of it. A path that turns by some angle in all stays
// within half its length times the tangent of half the angle of its chord.
Cylinder along_arc(const Warp& warp, const Warp::BendData& bend, const Interval& part, double radius) {
  const double on_arc = std::max(0.0, std::min(part.hi, bend.arc) - std::max(part.lo, 0.0));
  const double turn = on_arc / bend.arc_radius;
  const Vec3 from = warp.bent_axis(part.lo), to = warp.bent_axis(part.hi);
  const double chord = glm::distance(from, to);
  return {0.5 * (from + to), chord > 0 ? (to - from) / chord : bend.frame.axes[0],
          0.5 * chord + radius * std::sin(std::min(turn, 1.5)),
          radius + 0.5 * (part.hi - part.lo) * std::tan(0.5 * turn)};
}

}  // namespace

std::optional<Cylinder> cylinder_of(const FieldModel& model, std::uint32_t sum, const Tube& tube, double u, double from,
                                    double to) {
  const Interval part = tube.part(u, from, to);
  if (part.empty()) return std::nullopt;
  const double middle = 0.5 * (part.lo + part.hi), half = 0.5 * (part.hi - part.lo), radius = tube.reach(u, part);
  const Cylinder plain{tube.base + middle * tube.axis, tube.axis, half, radius};
  const Warp* warp = nullptr;
  bool is_warped_once = true;
  for (std::uint32_t at = model.operators[sum].kept_above; at != kNoOperator; at = model.operators[at].kept_above) {
    if (model.operators[at].op != FieldInstruction::Op::kEnterWarp) continue;
    is_warped_once = warp == nullptr;
    warp = &model.warps[model.operators[at].index];
  }
  if (!warp) return plain;
  const auto in_frame = [&](const Warp::Framed* frame) {
    const Vec3 center = frame ? frame->to_local(plain.center) : plain.center;
    const Vec3 axis = frame ? frame->to_local(plain.center + plain.axis) - center : plain.axis;
    return box_around(Cylinder{center, axis, half, radius});
  };
  const Warp::BendData* bend = warp->bend();
  if (!bend || !is_warped_once) return cylinder_around(box_in_world(model, sum, in_frame));
  const Vec3 start = bend->frame.to_local(tube.base), ahead = bend->frame.to_local(tube.base + tube.axis) - start;
  constexpr double kOff = 1e-6;
  const bool is_on_axis = std::hypot(start.y, start.z) <= kOff * bend->arc;
  if (is_on_axis && ahead.x > 0 && std::hypot(ahead.y, ahead.z) <= kOff) {
    return along_arc(*warp, *bend, {start.x + part.lo, start.x + part.hi}, radius + 2 * kOff * bend->arc);
  }
  Cylinder bent = cylinder_around(warp->bent_support(in_frame(&bend->frame)));
  bent.center = bend->frame.to_world(bent.center);
  bent.axis = bend->frame.axes[0];
  return bent;
}

namespace {

Cylinder support_cylinder(const FieldModel& model, std::uint32_t primitive) {
  if (model.other_at(primitive)) return cylinder_around(model.supports.box(primitive));
  const ConeRecord& cone = model.cones[primitive];
  Tube tube = tube_of(cone, model.kinds[primitive], model.units.scale);
  tube.has_levels = false;
  const std::optional<Cylinder> cylinder =
      cylinder_of(model, model.sum_of(primitive), tube, 1, tube.along.lo, tube.along.hi);
  return cylinder ? *cylinder : Cylinder{cone.base, {1, 0, 0}, 0, 0};
}

}  // namespace

std::vector<Cylinder> support_cylinders(const FieldModel& model) {
  std::vector<Cylinder> supports;
  resize_large(supports, model.cones.size());
  tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(supports.size()),
                    [&](std::uint32_t i) { supports[i] = support_cylinder(model, i); });
  return supports;
}

}  // namespace barkridge
