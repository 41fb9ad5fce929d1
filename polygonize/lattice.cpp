#include "polygonize/lattice.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "base/error.h"

namespace barkridge {

namespace {

constexpr double kMarginCells = 1e-3;

// The largest distance between floats that are neighbours and at most `x` large.
double float_spacing(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - static_cast<double>(f);
}

}  // namespace

Box box_of(const Lattice& lattice, const BlockRange& range) {
  return {lattice.point(kBlockCells * range.lo), lattice.point(kBlockCells * range.hi)};
}

Lattice make_lattice(const Box& support, double cell_size) {
  if (!(cell_size > 0) || !std::isfinite(cell_size)) {
    throw InputError(fmt::format("the cell size must be a positive number, not {}", cell_size));
  }
  const Vec3 farthest = glm::max(glm::abs(support.lo), glm::abs(support.hi));
  const double largest = std::max({farthest.x, farthest.y, farthest.z}) + 2 * cell_size;
  if (!(largest < static_cast<double>(std::numeric_limits<float>::max()))) {
    throw InputError(fmt::format("a model that reaches as far as {} cannot be polygonized", largest));
  }
  const double spacing = float_spacing(largest);
  const double margin = std::max(kMarginCells * cell_size, 2 * spacing);
  if (margin > cell_size / 4) {
    throw InputError(
        fmt::format("the cell size {} is too small for a model that reaches as far as {} from the origin: "
                    "meshes have coordinates of 32 bits, which need cells of at least {}",
                    cell_size, largest, 8 * spacing));
  }
  return {cell_size, margin};
}

}  // namespace barkridge
