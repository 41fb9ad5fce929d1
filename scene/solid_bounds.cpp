#include "scene/solid_bounds.h"

#include <memory>
#include <queue>

namespace barkridge {

namespace {

// A box that may hold solid, with a field that is as good as the whole one inside of it.
struct Candidate {
  double reach;
  Box box;
  std::shared_ptr<const Field> field;

  bool operator<(const Candidate& other) const { return reach < other.reach; }
};

double reach_of(const Box& box, const Vec3& direction) {
  return glm::dot(box.center(), direction) + glm::dot(box.half_extent(), glm::abs(direction));
}

Box octant(const Box& box, int index) {
  Box part = box;
  const Vec3 middle = box.center();
  for (int axis = 0; axis < 3; ++axis) {
    ((index >> axis) & 1 ? part.lo : part.hi)[axis] = middle[axis];
  }
  return part;
}

}  // namespace

std::optional<double> solid_reach(const Field& field, const Vec3& direction) {
  const Box support = field.support();
  if (support.empty()) return std::nullopt;
  const double smallest = support.diagonal() / 2048;
  // Best first: the first box that is small enough and may hold solid reaches as far as any.
  std::priority_queue<Candidate> queue;
  queue.push({reach_of(support, direction), support, std::shared_ptr<const Field>(&field, [](const Field*) {})});
  while (!queue.empty()) {
    const Candidate furthest = queue.top();
    queue.pop();
    if (furthest.box.diagonal() <= smallest) return furthest.reach;
    const std::shared_ptr<const Field> local = furthest.field->restricted(furthest.box);
    for (int i = 0; i < 8; ++i) {
      const Box part = octant(furthest.box, i);
      if (local->bounds(part).value.hi >= kIsoValue) queue.push({reach_of(part, direction), part, local});
    }
  }
  return std::nullopt;
}

Box solid_bounds(const Field& field) {
  Box bounds;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction(0);
    direction[axis] = 1;
    const std::optional<double> hi = solid_reach(field, direction), lo = solid_reach(field, -direction);
    if (!hi || !lo) return {};
    bounds.lo[axis] = -*lo;
    bounds.hi[axis] = *hi;
  }
  return bounds;
}

}  // namespace barkridge
