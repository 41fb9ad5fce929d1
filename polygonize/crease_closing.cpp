#include "polygonize/crease_closing.h"

#include <algorithm>
#include <array>
#include <bit>
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
                             const InsideRows& inside, std::vector<Vec3>& points, std::vector<double>& halo_values) {
  constexpr unsigned kRow = (1u << kBlockPoints) - 1;
  const auto row = [&](int y, int z) -> unsigned { return inside[static_cast<std::size_t>(z * kBlockPoints + y)]; };
  points.clear();
  const auto look_at = [&](unsigned places, int y, int z, const Step& halo_step) {
    for (; places != 0; places &= places - 1) {
      points.push_back(lattice.point(first + Step(std::countr_zero(places), y, z) + halo_step));
    }
  };
  for (int z = 0; z < kBlockPoints; ++z) {
    for (int y = 0; y < kBlockPoints; ++y) {
      const unsigned here = row(y, z), outside = ~here & kRow;
      if (outside == 0) continue;
      // Outside points with an inside one on both sides, along x, y and z; at either end the one in the halo is asked.
      if ((outside & here << 1 & here >> 1) != 0) return true;
      look_at(outside & here >> 1 & 1u, y, z, along(0, -1));
      look_at(outside & here << 1 & 1u << kBlockCells, y, z, along(0, 1));
      const unsigned below = y > 0 ? row(y - 1, z) : 0, above = y < kBlockCells ? row(y + 1, z) : 0;
      if ((outside & below & above) != 0) return true;
      if (y == 0) look_at(outside & above, y, z, along(1, -1));
      if (y == kBlockCells) look_at(outside & below, y, z, along(1, 1));
      const unsigned before = z > 0 ? row(y, z - 1) : 0, behind = z < kBlockCells ? row(y, z + 1) : 0;
      if ((outside & before & behind) != 0) return true;
      if (z == 0) look_at(outside & behind, y, z, along(2, -1));
      if (z == kBlockCells) look_at(outside & before, y, z, along(2, 1));
    }
  }
  halo_values.resize(points.size());
  with_halo.values(points, halo_values);
  return std::any_of(halo_values.begin(), halo_values.end(), is_inside);
}

}  // namespace barkridge
