// The oracle: every node at every point, by the formulas as they stand in docs/field.md, without recursion.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "blobtree/cone_record.h"
#include "blobtree/contact.h"
#include "blobtree/operator_bounds.h"
#include "blobtree/primitive.h"
#include "blobtree/primitive_bounds.h"
#include "blobtree/solid_noise.h"
#include "blobtree/warp.h"

namespace barkridge {

namespace {

using Children = std::span<const FieldSample>;

FieldSample combine(const Sum&, Children children) {
  FieldSample sum;
  for (const FieldSample& child : children) {
    sum.value += child.value;
    sum.gradient += child.gradient;
  }
  return sum;
}

FieldSample combine(const Ricci& ricci, Children children) {
  double powers = 0;
  for (const FieldSample& child : children) powers += std::pow(std::max(0.0, child.value), ricci.exponent);
  FieldSample blend{std::pow(powers, 1 / ricci.exponent), Vec3(0)};
  if (blend.value <= 0) return {};
  for (const FieldSample& child : children) {
    blend.gradient += std::pow(std::max(0.0, child.value) / blend.value, ricci.exponent - 1) * child.gradient;
  }
  return blend;
}

FieldSample combine(const Union&, Children children) {
  return *std::max_element(children.begin(), children.end(),
                           [](const auto& a, const auto& b) { return a.value < b.value; });
}

FieldSample combine(const Intersection&, Children children) {
  return *std::min_element(children.begin(), children.end(),
                           [](const auto& a, const auto& b) { return a.value < b.value; });
}

FieldSample combine(const Difference&, Children children) {
  const FieldSample& a = children.front();
  const FieldSample b = combine(Union{}, children.subspan(1));
  if (b.value <= 0) return a;
  // The complement 2T - F_B, not below 0, plus what A has above 2T, which fades out on the way to B's surface so that
  // the result passes into A without a jump where B ends.
  FieldSample complement{std::max(0.0, 2 * kIsoValue - b.value), b.value < 2 * kIsoValue ? -b.gradient : Vec3(0)};
  const double excess = a.value - 2 * kIsoValue;
  const double ramp = 1 - b.value / kIsoValue;
  if (excess > 0 && ramp > 0) {
    complement.value += ramp * excess;
    complement.gradient += ramp * a.gradient - excess / kIsoValue * b.gradient;
  }
  return a.value <= complement.value ? a : complement;
}

FieldSample combine(const Negative&, Children children) {
  FieldSample result = children.front();
  for (const FieldSample& child : children.subspan(1)) {
    result.value -= child.value;
    result.gradient -= child.gradient;
  }
  return result;
}

FieldSample combine(const Contact& contact, Children children) {
  const auto highest = std::max_element(children.begin(), children.end(),
                                        [](const auto& a, const auto& b) { return a.value < b.value; });
  FieldSample compression, expansion;
  for (auto child = children.begin(); child != children.end(); ++child) {
    if (child == highest) continue;
    if (child->value >= kIsoValue) {
      compression.value += child->value - kIsoValue;
      compression.gradient += child->gradient;
    } else {
      expansion.value += contact_expansion(contact.shape, kIsoValue - child->value);
      expansion.gradient -= contact_expansion_slope(contact.shape, kIsoValue - child->value) * child->gradient;
    }
  }
  FieldSample result = *highest;
  if (compression.value > 0) {
    const bool clamped = highest->value - compression.value < kIsoValue;
    result.value = clamped ? kIsoValue : highest->value - compression.value;
    result.gradient = clamped ? Vec3(0) : highest->gradient - compression.gradient;
  }
  return {result.value + expansion.value, result.gradient + expansion.gradient};
}

FieldSample displaced(const FieldSample& child, double amount, const Graded& noise) {
  const double factor = 1 + amount * noise.value;
  return {child.value * factor, child.gradient * factor + child.value * amount * noise.slope};
}

class ReferenceField final : public Field {
 public:
  explicit ReferenceField(const BlobTree& tree)
      : tree_(tree), supports_(supports_of(tree)), reached_(tree.nodes.size()) {
    if (tree_.nodes.empty()) return;
    reached_[tree_.root] = true;
    for (NodeId id = tree_.root + 1; id-- > 0;) {
      if (!reached_[id]) continue;
      for (const NodeId child : tree_.nodes[id].children) reached_[child] = true;
    }
    warps_.resize(tree_.nodes.size());
    for (NodeId id = 0; id <= tree_.root; ++id) {
      std::visit(
          [&](const auto& what) {
            if constexpr (std::is_same_v<std::decay_t<decltype(what)>, Bend>) {
              warps_[id] = std::make_unique<Warp>(what, supports_[tree_.nodes[id].children[0]]);
            } else if constexpr (std::is_constructible_v<Warp, decltype(what)>) {
              warps_[id] = std::make_unique<Warp>(what);
            }
          },
          tree_.nodes[id].what);
    }
  }

  Box support() const override { return tree_.nodes.empty() ? Box{} : supports_[tree_.root]; }

  void values(std::span<const Vec3> points, std::span<double> values) const override {
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { values[i] = at(points[i]).value; });
  }

  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override {
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
      const FieldSample sample = at(points[i]);
      values[i] = sample.value;
      gradients[i] = sample.gradient;
    });
  }

  FieldBounds bounds(const Box& box) const override {
    if (tree_.nodes.empty()) return {};
    // Boxes go down the tree, bounds come up.
    std::vector<WarpedBox> boxes(tree_.nodes.size());
    boxes[tree_.root].box = box;
    descend([&](NodeId parent, NodeId child) {
      boxes[child] = warps_[parent] ? warps_[parent]->map(boxes[parent].box) : WarpedBox{boxes[parent].box, 1};
    });
    std::vector<FieldBounds> bounds(tree_.nodes.size());
    std::vector<FieldBounds> children;
    ascend(bounds, children, [&](NodeId id, std::span<const FieldBounds> of_children) {
      return std::visit([&](const auto& what) { return node_bounds(what, id, boxes[id].box, boxes, of_children); },
                        tree_.nodes[id].what);
    });
    return bounds[tree_.root];
  }

  std::shared_ptr<const Field> restricted(const Box&) const override { return std::make_shared<ReferenceField>(*this); }

  std::size_t primitive_count() const override {
    std::size_t count = 0;
    for (NodeId id = 0; id < reached_.size(); ++id) count += reached_[id] && tree_.nodes[id].children.empty();
    return count;
  }

  ReferenceField(const ReferenceField& other) : ReferenceField(other.tree_) {}

 private:
  FieldSample at(const Vec3& p) const {
    if (tree_.nodes.empty()) return {};
    // Points go down the tree, samples come up.
    thread_local std::vector<Vec3> points;
    thread_local std::vector<FieldSample> samples, children;
    points.assign(tree_.nodes.size(), Vec3(0));
    samples.assign(tree_.nodes.size(), FieldSample{});
    points[tree_.root] = p;
    descend([&](NodeId parent, NodeId child) {
      points[child] = warps_[parent] ? warps_[parent]->map(points[parent]) : points[parent];
    });
    ascend(samples, children, [&](NodeId id, Children of_children) {
      return std::visit([&](const auto& what) { return node_sample(what, id, points[id], of_children); },
                        tree_.nodes[id].what);
    });
    return samples[tree_.root];
  }

  template <typename What>
  FieldSample node_sample(const What& what, NodeId id, const Vec3& p, Children children) const {
    if constexpr (requires { combine(what, children); }) {
      return combine(what, children);
    } else if constexpr (std::is_same_v<What, Displacement>) {
      return displaced(children[0], what.amount, sample(what.noise, p));
    } else if constexpr (std::is_same_v<What, Bend> || std::is_constructible_v<Warp, What>) {
      // Transposed Jacobian times gradient.
      return {children[0].value, children[0].gradient * warps_[id]->map_with_jacobian(p).jacobian};
    } else {
      return sample(what, p);
    }
  }

  template <typename What>
  FieldBounds node_bounds(const What& what, NodeId id, const Box& box, const std::vector<WarpedBox>& boxes,
                          std::span<const FieldBounds> children) const {
    if constexpr (requires { bounds_of(what, children); }) {
      return bounds_of(what, children);
    } else if constexpr (std::is_same_v<What, Displacement>) {
      return displaced(children[0], what.amount, bounds_of(what.noise, box.center(), glm::length(box.half_extent())));
    } else if constexpr (std::is_same_v<What, Bend> || std::is_constructible_v<Warp, What>) {
      return {children[0].value, children[0].slope * boxes[tree_.nodes[id].children[0]].stretch};
    } else {
      return bounds_where_supported(supports_[id], box, [&](const Box& part) {
        if constexpr (std::is_same_v<What, Cone>) {
          return bounds_of(record_of(what, 1), ConeKind::kPlain, {}, part).field;
        } else if constexpr (std::is_same_v<What, FadedCone>) {
          return bounds_of(record_of(what, 1), ConeKind::kFaded, {}, part).field;
        } else {
          return bounds_of(what, part);
        }
      });
    }
  }

  // Visits every parent before its children.
  template <typename Visit>
  void descend(Visit visit) const {
    for (NodeId id = tree_.root + 1; id-- > 0;) {
      if (!reached_[id]) continue;
      for (const NodeId child : tree_.nodes[id].children) visit(id, child);
    }
  }

  // Computes every node from its children.
  template <typename T, typename Compute>
  void ascend(std::vector<T>& results, std::vector<T>& children, Compute compute) const {
    for (NodeId id = 0; id <= tree_.root; ++id) {
      if (!reached_[id]) continue;
      children.clear();
      for (const NodeId child : tree_.nodes[id].children) children.push_back(results[child]);
      results[id] = compute(id, std::span<const T>(children));
    }
  }

  BlobTree tree_;
  std::vector<Box> supports_;
  std::vector<bool> reached_;
  std::vector<std::unique_ptr<const Warp>> warps_;  // where the node is one
};

}  // namespace

std::shared_ptr<const Field> reference_field(const BlobTree& tree) {
  check(tree);
  return std::make_shared<ReferenceField>(tree);
}

}  // namespace barkridge
