#include "polygonize/crease_closing.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace barkridge {

namespace {

bool is_inside(double value) { return value >= kIsoValue; }

// A lattice point relative to another.
using Step = glm::ivec3;

Step along(int axis, int cells) {
  Step step(0);
  step[axis] = cells;
  return step;
}

constexpr std::size_t index_in_cube(const Step& p, int points_a_side) {
  return static_cast<std::size_t>(p.x + points_a_side * (p.y + points_a_side * p.z));
}

// The inside points among the 26 neighbours of a point.
class Neighbourhood {
 public:
  Neighbourhood(const std::vector<double>& values, const Step& center) {
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Step step(x, y, z);
          inside_[index(step)] = is_inside(values[index_in_cube(center + step, kHaloPoints)]);
        }
      }
    }
  }

  bool inside(const Step& step) const { return inside_[index(step)]; }

  // Whether two inside points hang together by inside points that share a face with the next one, none of them a
  // corner.
  bool connected(const Step& from, const Step& to) const {
    std::array<bool, 27> seen{};
    std::array<Step, 27> open;
    std::size_t open_count = 0;
    seen[index(from)] = true;
    open[open_count++] = from;
    while (open_count > 0) {
      const Step here = open[--open_count];
      if (here == to) return true;
      for (int axis = 0; axis < 3; ++axis) {
        for (const int direction : {-1, 1}) {
          const Step next = here + along(axis, direction);
          const bool is_neighbour =
              std::abs(next[axis]) <= 1 && std::abs(next.x) + std::abs(next.y) + std::abs(next.z) <= 2;
          if (!is_neighbour || seen[index(next)] || !inside(next)) continue;
          seen[index(next)] = true;
          open[open_count++] = next;
        }
      }
    }
    return false;
  }

 private:
  static std::size_t index(const Step& step) { return index_in_cube(step + 1, 3); }

  std::array<bool, 27> inside_{};
};

bool is_crease_bottom(const Neighbourhood& around) {
  if (around.inside(Step(0))) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const Step before = along(axis, -1), after = along(axis, 1);
    if (around.inside(before) && around.inside(after) && around.connected(before, after)) return true;
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
        if (is_crease_bottom({values, place + kCreaseHalo})) bottoms.push_back(place);
      }
    }
  }
  return bottoms;
}

bool may_have_crease_bottoms(const Lattice& lattice, const Field& with_halo, const glm::ivec3& first,
                             const std::vector<double>& values, std::vector<Vec3>& points,
                             std::vector<double>& halo_values) {
  const auto inside = [&](const Step& place) { return is_inside(values[index_in_cube(place, kBlockPoints)]); };
  points.clear();
  for (int axis = 0; axis < 3; ++axis) {
    for (int row = 0; row < kBlockPoints * kBlockPoints; ++row) {
      Step start(0);
      start[(axis + 1) % 3] = row % kBlockPoints;
      start[(axis + 2) % 3] = row / kBlockPoints;
      for (int i = 1; i + 1 < kBlockPoints; ++i) {
        const Step place = start + along(axis, i);
        if (!inside(place) && inside(place - along(axis, 1)) && inside(place + along(axis, 1))) return true;
      }
      // At either end of the row the neighbour on one side is in the halo.
      const Step end = start + along(axis, kBlockCells);
      if (!inside(start) && inside(start + along(axis, 1)))
        points.push_back(lattice.point(first + start - along(axis, 1)));
      if (!inside(end) && inside(end - along(axis, 1))) points.push_back(lattice.point(first + end + along(axis, 1)));
    }
  }
  halo_values.resize(points.size());
  with_halo.values(points, halo_values);
  return std::any_of(halo_values.begin(), halo_values.end(), is_inside);
}

}  // namespace barkridge
