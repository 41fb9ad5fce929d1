#include "blobtree/tree.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "blobtree/node_fields.h"

namespace barkridge {

namespace {

bool finite(bool) { return true; }
bool finite(int) { return true; }
bool finite(double x) { return std::isfinite(x); }
bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(const Mat3& m) { return finite(m[0]) && finite(m[1]) && finite(m[2]); }
bool finite(const std::vector<Vec3>& points) {
  for (const Vec3& p : points) {
    if (!finite(p)) return false;
  }
  return true;
}

void require(bool condition, const char* rule) {
  if (!condition) throw InputError(rule);
}

void check_radius(double radius) { require(radius > 0, "radii must be above zero"); }

// Directions may have any length but none.
bool is_direction(const Vec3& v) { return glm::length(v) > 0; }

void check_node(const Cone& cone) {
  check_radius(cone.base_radius);
  check_radius(cone.tip_radius);
}
void check_node(const FadedCone& cone) {
  check_radius(cone.base_radius);
  check_radius(cone.tip_radius);
  require(cone.parent_radius >= 0 && cone.child_radius >= 0, "parent_radius and child_radius must not be negative");
  require(is_direction(cone.tip - cone.base), "base and tip must differ");
}
void check_node(const Disc& disc) {
  check_radius(disc.radius);
  require(disc.disc_radius >= 0, "disc_radius must not be negative");
  require(is_direction(disc.normal), "normal must not be zero");
}
void check_node(const Ring& ring) {
  check_radius(ring.radius);
  require(ring.ring_radius >= 0, "ring_radius must not be negative");
  require(is_direction(ring.normal), "normal must not be zero");
}
void check_node(const Polygon& polygon) {
  check_radius(polygon.radius);
  require(polygon.vertices.size() >= 3, "a polygon needs at least three vertices");
  Vec3 normal(0);
  double size = 0;
  const Vec3& first = polygon.vertices.front();
  for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
    normal += glm::cross(polygon.vertices[i] - first, polygon.vertices[i + 1] - first);
    size = std::max({size, glm::distance(polygon.vertices[i], first), glm::distance(polygon.vertices[i + 1], first)});
  }
  require(glm::length(normal) > 1e-12 * size * size, "a polygon's vertices must not lie on a line");
  normal = glm::normalize(normal);
  for (const Vec3& vertex : polygon.vertices) {
    require(std::abs(glm::dot(vertex - first, normal)) <= 1e-6 * size, "a polygon's vertices must lie in one plane");
  }
}
void check_node(const Ricci& ricci) { require(ricci.exponent >= 1, "exponent must be at least 1"); }
void check_node(const Contact& contact) { check(contact.shape); }
void check_node(const Displacement& displacement) {
  require(0 <= displacement.amount && displacement.amount < 1, "amount must be at least 0 and below 1");
  require(displacement.noise.wavelength > 0, "wavelength must be above zero");
  require(displacement.noise.stretch > 0, "stretch must be above zero");
  require(1 <= displacement.noise.octaves && displacement.noise.octaves <= kMostNoiseOctaves,
          "octaves must be from 1 to 8");
}
void check_node(const Bend& bend) {
  require(is_direction(bend.tip - bend.base), "base and tip must differ");
  require(0 < bend.angle_degrees && bend.angle_degrees < 180, "angle_degrees must be above 0 and below 180");
  const Vec3 side = glm::cross(bend.direction, bend.tip - bend.base);
  require(glm::length(side) > 1e-9 * glm::length(bend.direction) * glm::length(bend.tip - bend.base),
          "direction must not lie along the axis");
}
void check_node(const Twist& twist) { require(is_direction(twist.axis), "axis must not be zero"); }
void check_node(const Taper& taper) {
  require(is_direction(taper.tip - taper.base), "base and tip must differ");
  require(taper.tip_scale > 0, "tip_scale must be above zero");
}
void check_node(const Affine& affine) {
  const Mat3& m = affine.linear;
  const double size = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  require(std::abs(glm::determinant(m)) > 1e-12 * size, "linear must be invertible");
}
template <typename Operator>
void check_node(const Operator&) {}

// How many children a kind of node has.
template <typename What>
void check_child_count(std::size_t count) {
  if constexpr (std::is_same_v<What, Bend> || std::is_same_v<What, Twist> || std::is_same_v<What, Taper> ||
                std::is_same_v<What, Affine>) {
    require(count == 1, "a warp has exactly one child");
  } else if constexpr (std::is_same_v<What, Displacement>) {
    require(count == 1, "needs exactly one child");
  } else if constexpr (std::is_same_v<What, Difference> || std::is_same_v<What, Negative>) {
    require(count >= 2, "needs at least two children");
  } else if constexpr (std::is_same_v<What, Sum> || std::is_same_v<What, Ricci> || std::is_same_v<What, Union> ||
                       std::is_same_v<What, Intersection> || std::is_same_v<What, Contact>) {
    require(count >= 1, "needs at least one child");
  } else {
    require(count == 0, "a primitive has no children");
  }
}

}  // namespace

NodeId BlobTree::add(decltype(Node::what) what, std::vector<NodeId> children) {
  nodes.push_back({std::move(what), std::move(children)});
  root = static_cast<NodeId>(nodes.size() - 1);
  return root;
}

void check(const Node& node) {
  std::visit(
      [&](const auto& what) {
        using What = std::decay_t<decltype(what)>;
        try {
          for_each_field(what, [](const char* name, const auto& member) {
            if (!finite(member)) throw InputError(fmt::format("{} must be finite", name));
          });
          check_node(what);
          check_child_count<What>(node.children.size());
        } catch (const InputError& error) {
          throw InputError(fmt::format("{}: {}", kNodeName<What>, error.message()));
        }
      },
      node.what);
}

namespace {

// The number of the first node that breaks a rule of its own, or of all nodes.
std::size_t first_wrong_by_itself(const BlobTree& tree) {
  using Range = tbb::blocked_range<std::size_t>;
  constexpr std::size_t kTogether = 1024;
  const std::size_t none = tree.nodes.size();
  return tbb::parallel_reduce(
      Range(0, none, kTogether), none,
      [&](const Range& range, std::size_t first) {
        for (std::size_t id = range.begin(); id < std::min(range.end(), first); ++id) {
          try {
            check(tree.nodes[id]);
          } catch (const InputError&) {
            first = id;
          }
        }
        return first;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

}  // namespace

void check(const BlobTree& tree) {
  if (tree.nodes.empty()) return;
  if (tree.root >= tree.nodes.size()) throw InputError("the root is not a node of the tree");
  const std::size_t wrong = first_wrong_by_itself(tree);
  std::vector<bool> has_parent(tree.nodes.size());
  for (NodeId id = 0; id < tree.nodes.size(); ++id) {
    if (id == wrong) check(tree.nodes[id]);
    for (const NodeId child : tree.nodes[id].children) {
      if (child >= id) throw InputError(fmt::format("node {}: child {} does not come before its parent", id, child));
      if (has_parent[child]) throw InputError(fmt::format("node {}: child {} has another parent", id, child));
      has_parent[child] = true;
    }
  }
}

std::size_t depth(const BlobTree& tree) {
  if (tree.nodes.empty()) return 0;
  std::vector<std::size_t> depths(tree.nodes.size(), 1);
  for (NodeId id = 0; id <= tree.root; ++id) {
    for (const NodeId child : tree.nodes[id].children) depths[id] = std::max(depths[id], depths[child] + 1);
  }
  return depths[tree.root];
}

}  // namespace barkridge
