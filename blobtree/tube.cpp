#include "blobtree/tube.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/large_room.h"

namespace barkridge {

Tube tube_of(const ConeRecord& c, ConeKind kind, double scale) {
  const ConeSupport support = support_of(c, kind);
  Tube tube{c.base,
            Vec3(c.axis),
            c.base_radius / scale,
            c.taper,
            c.length / scale,
            {support.along.lo / scale, support.along.hi / scale},
            c.has_free_base(),
            c.has_free_tip()};
  if (4 * tube.taper * tube.taper > 0.5 || kind == ConeKind::kLimited) tube.limit = support.lateral / scale;
  return tube;
}

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
  tube.limit = support_of(cone, model.kinds[primitive]).lateral / model.units.scale;
  const std::optional<Cylinder> cylinder =
      cylinder_of(model, model.sums[primitive], tube, 1, tube.along.lo, tube.along.hi);
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
