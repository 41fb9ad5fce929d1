#include "lsystem/limbs.h"

#include <algorithm>
#include <vector>

namespace barkridge {

namespace {

double radius_of(const Internode& internode) { return std::max(internode.base_radius, internode.tip_radius); }

// Between two segments. [Ericson 2005, section 5.1.9]
double distance(const Internode& a, const Internode& b) {
  const Vec3 u = a.tip - a.base, v = b.tip - b.base, w = a.base - b.base;
  const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
  const auto part = [](double numerator, double denominator) {
    return denominator > 0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
  };
  double s = part(uv * vw - vv * uw, uu * vv - uv * uv);
  const double t = part(uv * s + vw, vv);
  s = part(uv * t - uw, uu);
  return glm::length(w + s * u - t * v);
}

// Whether `b`, which comes after `a`, begins at an end of it.
bool share_end(const Skeleton& skeleton, std::size_t a, std::size_t b) {
  const Internode &first = skeleton.internodes[a], &second = skeleton.internodes[b];
  if (second.parent == static_cast<InternodeId>(a)) return true;
  return first.parent == second.parent && (first.parent != kNoInternode || first.base == second.base);
}

}  // namespace

std::size_t crossing_limbs(const Skeleton& skeleton, double reach) {
  struct Limb {
    Box box;
    std::size_t internode;
  };
  std::vector<Limb> limbs;
  limbs.reserve(skeleton.internodes.size());
  Box all;
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    const Internode& internode = skeleton.internodes[i];
    const Box box = grown(unite(unite(Box{}, internode.base), internode.tip), reach * radius_of(internode));
    limbs.push_back({box, i});
    all = unite(all, box);
  }
  // Swept along the longest extent.
  const Vec3 size = all.hi - all.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::sort(limbs.begin(), limbs.end(), [&](const Limb& a, const Limb& b) {
    return a.box.lo[axis] != b.box.lo[axis] ? a.box.lo[axis] < b.box.lo[axis] : a.internode < b.internode;
  });
  std::size_t pairs = 0;
  for (auto a = limbs.begin(); a != limbs.end(); ++a) {
    for (auto b = a + 1; b != limbs.end() && b->box.lo[axis] <= a->box.hi[axis]; ++b) {
      if (!a->box.overlaps(b->box)) continue;
      const auto [lower, upper] = std::minmax(a->internode, b->internode);
      if (share_end(skeleton, lower, upper)) continue;
      const Internode &one = skeleton.internodes[lower], &other = skeleton.internodes[upper];
      if (distance(one, other) < reach * (radius_of(one) + radius_of(other))) ++pairs;
    }
  }
  return pairs;
}

}  // namespace barkridge
