#include "scene/solid_bounds.h"

#include <memory>
#include <queue>
#include <vector>

namespace barkridge {

namespace {

// A box that may hold solid, with a field that is as good as the whole one inside of it.
struct Candidate {
  double reach = 0;  // how far it extends to the side that is sought
  Box box;
  std::shared_ptr<const Field> field;

  bool operator<(const Candidate& other) const { return reach < other.reach; }
};

double reach_of(const Box& box, int axis, bool upper) { return upper ? box.hi[axis] : -box.lo[axis]; }

Box octant(const Box& box, int index) {
  Box part = box;
  const Vec3 middle = box.center();
  for (int axis = 0; axis < 3; ++axis) {
    ((index >> axis) & 1 ? part.lo : part.hi)[axis] = middle[axis];
  }
  return part;
}

// Best first: the first box that is small enough and still may hold solid reaches as far as any. `solid` tells by
// `root` whether there is any.
bool furthest_reach(const Candidate& root, int axis, bool upper, double smallest, double& reach) {
  std::priority_queue<Candidate> queue;
  queue.push(root);
  while (!queue.empty()) {
    const Candidate top = queue.top();
    queue.pop();
    if (top.box.hi[axis] - top.box.lo[axis] <= smallest) {
      reach = top.reach;
      return true;
    }
    const std::shared_ptr<const Field> field = top.field->restricted(top.box);
    for (int i = 0; i < 8; ++i) {
      const Box part = octant(top.box, i);
      if (field->bounds(part).value.hi >= kIsoValue) queue.push({reach_of(part, axis, upper), part, field});
    }
  }
  return false;
}

}  // namespace

Box solid_bounds(const Field& field) {
  const Box support = field.support();
  if (support.empty()) return {};
  const double smallest = support.diagonal() / 1024;
  const std::shared_ptr<const Field> whole(&field, [](const Field*) {});
  Box bounds;
  for (int axis = 0; axis < 3; ++axis) {
    double lo = 0, hi = 0;
    if (!furthest_reach({0, support, whole}, axis, false, smallest, lo)) return {};
    if (!furthest_reach({0, support, whole}, axis, true, smallest, hi)) return {};
    bounds.lo[axis] = -lo;
    bounds.hi[axis] = hi;
  }
  return bounds;
}

}  // namespace barkridge
