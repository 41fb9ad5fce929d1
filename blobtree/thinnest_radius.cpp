#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

#include "base/large_room.h"
#include "blobtree/tree.h"

namespace barkridge {

namespace {

// A bound from below of the factor by which a node makes its children smaller.
struct SmallestScale {
  double operator()(const Taper& taper) const { return std::min(1.0, taper.tip_scale); }
  double operator()(const Affine& affine) const {
    const Mat3 inverse = glm::inverse(affine.linear);
    double largest = 0;
    for (int row = 0; row < 3; ++row) {
      largest = std::max(largest, std::abs(inverse[0][row]) + std::abs(inverse[1][row]) + std::abs(inverse[2][row]));
    }
    return 1 / largest;
  }
  template <typename Other>
  double operator()(const Other&) const {
    return 1;
  }
};

struct PrimitiveRadius {
  double operator()(const Cone& p) const { return std::min(p.base_radius, p.tip_radius); }
  double operator()(const FadedCone& p) const { return std::min(p.base_radius, p.tip_radius); }
  double operator()(const Disc& p) const { return p.radius; }
  double operator()(const Ring& p) const { return p.radius; }
  double operator()(const Polygon& p) const { return p.radius; }
  template <typename Operator>
  double operator()(const Operator&) const {
    return std::numeric_limits<double>::infinity();
  }
};

struct FinestWavelength {
  double operator()(const Displacement& d) const {
    return d.noise.wavelength * std::min(1.0, d.noise.stretch) / std::exp2(d.noise.octaves - 1);
  }
  template <typename Other>
  double operator()(const Other&) const {
    return std::numeric_limits<double>::infinity();
  }
};

// The smallest of the sizes of nodes that the root reaches, each scaled by the nodes above it.
template <typename Size>
double smallest_scaled(const BlobTree& tree, Size size) {
  // From the root down, for parents come after their children; 0 marks what the root does not reach.
  std::vector<double> scale;
  resize_large(scale, tree.nodes.size());
  if (!scale.empty()) scale[tree.root] = 1;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    if (scale[i] == 0) continue;
    const Node& node = tree.nodes[i];
    smallest = std::min(smallest, scale[i] * std::visit(size, node.what));
    for (const NodeId child : node.children) scale[child] = scale[i] * std::visit(SmallestScale{}, node.what);
  }
  return smallest;
}

}  // namespace

double thinnest_radius(const BlobTree& tree) {
  const double thinnest = smallest_scaled(tree, PrimitiveRadius{});
  return std::isfinite(thinnest) ? thinnest : 0;
}

double finest_wavelength(const BlobTree& tree) { return smallest_scaled(tree, FinestWavelength{}); }

}  // namespace barkridge
