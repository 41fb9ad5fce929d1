#include "scene/solid_bounds.h"

#include <algorithm>
#include <memory>
#include <queue>
#include <vector>

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

// The octants of a candidate that may hold solid, the furthest last.
std::vector<Candidate> divided(const Candidate& candidate, const Vec3& direction) {
  constexpr std::size_t kWorthRestricting = 4;
  std::shared_ptr<const Field> field = candidate.field;
  if (field->primitive_count() > kWorthRestricting) field = field->restricted(candidate.box);
  std::vector<Candidate> parts;
  for (int i = 0; i < 8; ++i) {
    const Box part = octant(candidate.box, i);
    if (field->bounds(part).value.hi >= kIsoValue) parts.push_back({reach_of(part, direction), part, field});
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

// The reach of the first small box that may hold solid, furthest octants first: nearly the candidate's reach, soon.
std::optional<double> reach_within(const Candidate& candidate, const Vec3& direction, double smallest) {
  std::vector<Candidate> stack = {candidate};
  while (!stack.empty()) {
    const Candidate last = stack.back();
    stack.pop_back();
    if (last.box.diagonal() <= smallest) return last.reach;
    for (Candidate& part : divided(last, direction)) stack.push_back(std::move(part));
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> solid_reach(const Field& field, const Vec3& direction) {
  constexpr int kMostBoxes = 8192;
  const Box support = field.support();
  if (support.empty()) return std::nullopt;
  const double smallest = support.diagonal() / 2048;
  // Best first: the first box that is small enough and may hold solid reaches as far as any.
  std::priority_queue<Candidate> queue;
  queue.push({reach_of(support, direction), support, std::shared_ptr<const Field>(&field, [](const Field*) {})});
  for (int boxes = 0; !queue.empty(); ++boxes) {
    const Candidate furthest = queue.top();
    queue.pop();
    if (furthest.box.diagonal() <= smallest) return furthest.reach;
    if (boxes < kMostBoxes) {
      for (Candidate& part : divided(furthest, direction)) queue.push(std::move(part));
    } else if (const std::optional<double> reach = reach_within(furthest, direction, smallest)) {
      // All over a broad flat face boxes reach equally far: one of them stands for all.
      return reach;
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
