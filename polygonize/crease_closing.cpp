#include "polygonize/crease_closing.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace barkridge {

namespace {

constexpr std::array<int, 3> kStride{1, kHaloPoints, kHaloPoints* kHaloPoints};
constexpr int kWindow = 2 * kCreaseHalo + 1;

bool is_inside(double value) { return value >= kIsoValue; }

// A lattice point relative to another.
using Step = glm::ivec3;

Step along(int axis, int cells) {
  Step step(0);
  step[axis] = cells;
  return step;
}

int offset(const Step& step) { return step.x + kStride[1] * step.y + kStride[2] * step.z; }

// Whether two inside points hang together by inside points of the window around `center`.
bool connected_nearby(const std::vector<double>& values, int center, const Step& from, const Step& to) {
  std::array<bool, kWindow * kWindow * kWindow> seen{};
  const auto visited = [&](const Step& s) -> bool& {
    const Step at = s + kCreaseHalo;
    return seen[static_cast<std::size_t>(at.x + kWindow * (at.y + kWindow * at.z))];
  };
  std::array<Step, kWindow * kWindow * kWindow> open;
  std::size_t open_count = 0;
  visited(from) = true;
  open[open_count++] = from;
  while (open_count > 0) {
    const Step here = open[--open_count];
    if (here == to) return true;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int direction : {-1, 1}) {
        const Step next = here + along(axis, direction);
        if (std::abs(next[axis]) > kCreaseHalo || visited(next)) continue;
        if (!is_inside(values[static_cast<std::size_t>(center + offset(next))])) continue;
        visited(next) = true;
        open[open_count++] = next;
      }
    }
  }
  return false;
}

// Whether an outside point has inside points on both sides along an axis, with no more than one other between, that
// hang together nearby.
bool is_crease_bottom(const std::vector<double>& values, int center) {
  const auto inside_at = [&](const Step& step) {
    return is_inside(values[static_cast<std::size_t>(center + offset(step))]);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& [before, after] : {std::pair{-1, 1}, std::pair{-1, 2}, std::pair{-2, 1}}) {
      const Step a = along(axis, before), b = along(axis, after);
      if (inside_at(a) && inside_at(b) && connected_nearby(values, center, a, b)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<glm::ivec3> crease_bottoms(const std::vector<double>& values) {
  std::vector<glm::ivec3> bottoms;
  for (int z = 0; z < kBlockPoints; ++z) {
    for (int y = 0; y < kBlockPoints; ++y) {
      for (int x = 0; x < kBlockPoints; ++x) {
        const Step place(x, y, z);
        const int center = offset(place + kCreaseHalo);
        if (is_inside(values[static_cast<std::size_t>(center)])) continue;
        if (is_crease_bottom(values, center)) bottoms.push_back(place);
      }
    }
  }
  return bottoms;
}

bool may_have_crease_bottoms(const Lattice& lattice, const Field& with_halo, const glm::ivec3& first,
                             const std::vector<double>& values, std::vector<Vec3>& points,
                             std::vector<double>& halo_values) {
  static constexpr std::array<int, 3> kBlockStride{1, kBlockPoints, kBlockPoints * kBlockPoints};
  points.clear();
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int row = 0; row < kBlockPoints * kBlockPoints; ++row) {
      Step start(0);
      start[u] = row % kBlockPoints;
      start[v] = row / kBlockPoints;
      const int at_start =
          start[u] * kBlockStride[static_cast<std::size_t>(u)] + start[v] * kBlockStride[static_cast<std::size_t>(v)];
      int last_inside = -1;
      for (int i = 0; i < kBlockPoints; ++i) {
        if (!is_inside(values[static_cast<std::size_t>(at_start + i * kBlockStride[static_cast<std::size_t>(axis)])]))
          continue;
        const int outside_between = i - last_inside - 1;
        if (last_inside >= 0 && 1 <= outside_between && outside_between <= 2) return true;
        // A short stretch at the row's start may end just before it.
        if (last_inside < 0 && 1 <= i && i <= 2) {
          for (int beyond = 1; i + beyond <= 3; ++beyond)
            points.push_back(lattice.point(first + start + along(axis, -beyond)));
        }
        last_inside = i;
      }
      const int outside_at_end = kBlockPoints - 1 - last_inside;
      if (last_inside >= 0 && 1 <= outside_at_end && outside_at_end <= 2) {
        for (int beyond = 0; outside_at_end + beyond <= 2; ++beyond) {
          points.push_back(lattice.point(first + start + along(axis, kBlockPoints + beyond)));
        }
      }
    }
  }
  halo_values.resize(points.size());
  with_halo.values(points, halo_values);
  return std::any_of(halo_values.begin(), halo_values.end(), is_inside);
}

}  // namespace barkridge
