#include <algorithm>
#include <cmath>

#include "blobtree/contact.h"
#include "blobtree/field_model.h"
#include "blobtree/morton.h"
#include "blobtree/operator_bounds.h"
#include "blobtree/primitive_bounds.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

bool is_primitive(const Node& node) { return node.children.empty(); }

// How deep a stack a node's evaluation needs when its children go by falling need. [Sethi and Ullman 1970]
std::vector<std::uint32_t> stack_needs(const BlobTree& tree) {
  std::vector<std::uint32_t> needs(tree.nodes.size(), 1);
  std::vector<std::uint32_t> of_children;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (tree.nodes[i].children.empty()) continue;
    of_children.clear();
    for (const NodeId child : tree.nodes[i].children) {
      if (!is_primitive(tree.nodes[child])) of_children.push_back(needs[child]);
    }
    std::sort(of_children.begin(), of_children.end(), std::greater<>());
    for (std::uint32_t k = 0; k < of_children.size(); ++k) needs[i] = std::max(needs[i], of_children[k] + k);
  }
  return needs;
}

// A primitive's support as a box in a frame; for cones along the frame's axis that is much less than the frame's box
// around the box in the world.
Box support_in_frame(const Node& node, const Box& support, const Warp::Framed& frame) {
  return std::visit(
      [&](auto what) -> Box {
        if constexpr (std::is_same_v<decltype(what), Cone> || std::is_same_v<decltype(what), FadedCone>) {
          what.base = frame.to_local(what.base);
          what.tip = frame.to_local(what.tip);
          return support_of(what);
        } else {
          return frame.to_local(support);
        }
      },
      node.what);
}

class ModelCompiler {
 public:
  explicit ModelCompiler(const BlobTree& tree)
      : tree_(tree), needs_(stack_needs(tree)), model_(std::make_shared<FieldModel>()) {}

  std::shared_ptr<const FieldModel> run() {
    if (tree_.nodes.empty()) return model_;
    supports_ = supports_of(tree_);
    find_units();
    find_negatives();
    visit(tree_.root, kNoOperator, 0);
    while (!pending_.empty()) {
      const Task task = pending_.back();
      pending_.pop_back();
      task.primitives_of_sum ? write_primitives(task.parent) : visit(task.node, task.parent, task.rank);
    }
    finish();
    return model_;
  }

 private:
  // Either a node to visit, or a sum whose other operands have been written; a stack of them stands in for recursion.
  struct Task {
    NodeId node = 0;
    std::uint32_t parent = kNoOperator;
    std::uint8_t rank = 0;
    bool primitives_of_sum = false;
  };

  void find_units() {
    model_->support = supports_[tree_.root];
    const Vec3 size = model_->support.empty() ? Vec3(1) : model_->support.hi - model_->support.lo;
    const double largest = std::max({size.x, size.y, size.z});
    int exponent = 0;
    if (largest > 0 && std::isfinite(largest)) std::frexp(largest, &exponent);
    model_->units.scale = std::ldexp(1.0, -exponent);
    // Coarse enough for most batches to have one origin, fine enough for the thinnest twig.
    constexpr double kThinnestRadii = 128;
    const double wanted = kThinnestRadii * thinnest_radius(tree_) * model_->units.scale;
    model_->units.origin_spacing = std::exp2(std::round(std::log2(std::clamp(wanted, 0x1p-14, 0x1p-4))));
  }

  // Whether any field can be negative: then a missing operand of a union or a contact, which is zero, counts.
  void find_negatives() {
    for (const Node& node : tree_.nodes) has_negatives_ = has_negatives_ || std::holds_alternative<Negative>(node.what);
  }

  std::uint32_t add_operator(Op op, std::size_t operand_count, std::size_t index, std::uint32_t parent,
                             std::uint8_t rank) {
    FieldOperator node{op};
    node.is_kept = op == Op::kNegate || op == Op::kRicci || op == Op::kIntersection || op == Op::kDifference ||
                   op == Op::kEnterWarp || (has_negatives_ && (op == Op::kUnion || op == Op::kContact));
    node.rank = rank;
    node.index = static_cast<std::uint32_t>(index);
    node.operand_count = static_cast<std::uint32_t>(operand_count);
    node.parent = parent;
    if (parent != kNoOperator) {
      const FieldOperator& above = model_->operators[parent];
      node.depth = above.depth + 1;
      node.kept_above = above.is_kept ? parent : above.kept_above;
      node.kept_rank = above.is_kept ? rank : above.kept_rank;
    }
    model_->operators.push_back(node);
    return static_cast<std::uint32_t>(model_->operators.size() - 1);
  }

  void visit(NodeId id, std::uint32_t parent, std::uint8_t rank) {
    const Node& node = tree_.nodes[id];
    if (is_primitive(node) || std::holds_alternative<Sum>(node.what)) {
      visit_sum(id, add_operator(Op::kSum, 1, 0, parent, rank));
    } else {
      std::visit([&](const auto& what) { visit_operator(what, id, parent, rank); }, node.what);
    }
  }

  // Nested sums are one. Its primitives come last, in a row.
  void visit_sum(NodeId id, std::uint32_t sum) {
    std::vector<NodeId> nested{id}, others;
    std::vector<NodeId>& primitives = waiting_.emplace_back();
    while (!nested.empty()) {
      const NodeId next = nested.back();
      nested.pop_back();
      const Node& node = tree_.nodes[next];
      if (is_primitive(node)) {
        primitives.push_back(next);
      } else if (std::holds_alternative<Sum>(node.what)) {
        nested.insert(nested.end(), node.children.rbegin(), node.children.rend());
      } else {
        others.push_back(next);
      }
    }
    sort_in_space(primitives);
    pending_.push_back({0, sum, 0, true});
    visit_later(std::move(others), sum);
  }

  void sort_in_space(std::vector<NodeId>& primitives) const {
    constexpr std::size_t kFew = 8;
    if (primitives.size() <= kFew) return;
    std::vector<std::pair<std::uint64_t, NodeId>> order;
    order.reserve(primitives.size());
    Box box;
    for (const NodeId id : primitives) box = unite(box, supports_[id]);
    for (const NodeId id : primitives) order.emplace_back(morton_code(supports_[id].center(), box), id);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < order.size(); ++i) primitives[i] = order[i].second;
  }

  // Pushed last is visited first: the child of the greatest need.
  void visit_later(std::vector<NodeId> children, std::uint32_t parent, std::uint8_t rank = 0) {
    std::stable_sort(children.begin(), children.end(), [&](NodeId a, NodeId b) { return needs_[a] < needs_[b]; });
    for (const NodeId child : children) pending_.push_back({child, parent, rank});
  }

  void visit_commutative(Op op, NodeId id, std::uint32_t parent, std::uint8_t rank, std::size_t index = 0) {
    const std::vector<NodeId>& children = tree_.nodes[id].children;
    visit_later(children, add_operator(op, children.size(), index, parent, rank));
  }
  void visit_operator(const Union&, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    visit_commutative(Op::kUnion, id, parent, rank);
  }
  void visit_operator(const Intersection&, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    visit_commutative(Op::kIntersection, id, parent, rank);
  }
  void visit_operator(const Ricci& ricci, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    model_->exponents.push_back(ricci.exponent);
    visit_commutative(Op::kRicci, id, parent, rank, model_->exponents.size() - 1);
  }
  void visit_operator(const Contact& contact, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    // A tree from a skeleton has one shape for all its contacts.
    std::vector<ContactShape>& shapes = model_->contacts;
    if (shapes.empty() || !(shapes.back() == contact.shape)) shapes.push_back(contact.shape);
    model_->is_below_sum = model_->is_below_sum && is_below_sum(contact.shape);
    visit_commutative(Op::kContact, id, parent, rank, shapes.size() - 1);
  }
  void visit_operator(const Negative&, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    const std::vector<NodeId>& children = tree_.nodes[id].children;
    const std::uint32_t sum = add_operator(Op::kSum, children.size(), 0, parent, rank);
    for (std::size_t i = children.size(); i-- > 1;) {
      pending_.push_back({children[i], add_operator(Op::kNegate, 1, 0, sum, 0), 0});
    }
    pending_.push_back({children[0], sum, 0});
  }
  void visit_operator(const Difference&, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    const std::vector<NodeId>& children = tree_.nodes[id].children;
    const std::uint32_t difference = add_operator(Op::kDifference, 2, 0, parent, rank);
    const std::uint32_t taken = add_operator(Op::kUnion, children.size() - 1, 0, difference, 1);
    visit_later({children.begin() + 1, children.end()}, taken);
    pending_.push_back({children[0], difference, 0});
  }

  void visit_warp(Warp warp, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    model_->warps.push_back(std::move(warp));
    pending_.push_back(
        {tree_.nodes[id].children[0], add_operator(Op::kEnterWarp, 1, model_->warps.size() - 1, parent, rank), 0});
  }
  void visit_operator(const Bend& bend, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    visit_warp(Warp(bend, supports_[tree_.nodes[id].children[0]]), id, parent, rank);
  }
  template <typename W>
  requires std::is_constructible_v<Warp, W>
  void visit_operator(const W& warp, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    visit_warp(Warp(warp), id, parent, rank);
  }
  template <typename What>
  void visit_operator(const What&, NodeId, std::uint32_t, std::uint8_t) {}  // sums and primitives: see `visit`

  void write_primitives(std::uint32_t sum) {
    for (const NodeId id : waiting_.back()) {
      std::visit([&](const auto& what) { write_primitive(what, id); }, tree_.nodes[id].what);
      model_->sums.push_back(sum);
      boxes_.push_back(box_in_world(*model_, sum, [&](const Warp::Framed* frame) {
        return frame ? support_in_frame(tree_.nodes[id], supports_[id], *frame) : supports_[id];
      }));
    }
    waiting_.pop_back();
  }

  void write_primitive(const Cone& cone, NodeId) { write_cone(record_of(cone, model_->units.scale), ConeKind::kPlain); }
  void write_primitive(const FadedCone& cone, NodeId) {
    const ConeRecord record = record_of(cone, model_->units.scale);
    write_cone(record, kind_of_faded(record));
  }
  template <typename Shape>
  void write_primitive(const Shape& shape, NodeId id) {
    if constexpr (std::is_constructible_v<std::variant<Disc, Ring, Polygon>, Shape>) {
      model_->others.push_back({static_cast<std::uint32_t>(model_->cones.size()), shape, supports_[id]});
      write_cone({}, ConeKind::kPlain);
    }
  }
  void write_cone(const ConeRecord& record, ConeKind kind) {
    model_->cones.push_back(record);
    model_->kinds.push_back(kind);
  }

  void finish() {
    FieldModel& model = *model_;
    model.supports = BoxHierarchy(boxes_);
    std::vector<std::uint32_t> ancestors;
    ancestors.reserve(model.sums.size());
    for (std::size_t i = 0; i + 1 < model.sums.size(); ++i) {
      std::uint32_t a = model.sums[i], b = model.sums[i + 1];
      while (a != b) {
        std::uint32_t& deeper = model.operators[a].depth < model.operators[b].depth ? b : a;
        deeper = model.operators[deeper].parent;
      }
      ancestors.push_back(a);
    }
    model.ancestors.build(std::move(ancestors), model.operators);
    model.cones.shrink_to_fit();
    model.kinds.shrink_to_fit();
    model.sums.shrink_to_fit();
    model.operators.shrink_to_fit();
    model.warps.shrink_to_fit();
    // No primitive's field exceeds 1, and no contact adds more than that for each of its children.
    model.takes_away = std::any_of(model.operators.begin(), model.operators.end(), [](const FieldOperator& node) {
      return node.op == Op::kNegate || node.op == Op::kDifference;
    });
    const auto most = static_cast<double>(model.cones.size());
    model.bounds = {{has_negatives_ ? -most : 0, most}, std::numeric_limits<double>::infinity()};
  }

  const BlobTree& tree_;
  std::vector<std::uint32_t> needs_;
  std::vector<Box> supports_;
  bool has_negatives_ = false;
  std::vector<Task> pending_;
  std::vector<std::vector<NodeId>> waiting_;  // primitives of the sums whose other operands are being written
  std::vector<Box> boxes_;
  std::shared_ptr<FieldModel> model_;
};

}  // namespace

std::shared_ptr<const FieldModel> compile_model(const BlobTree& tree) { return ModelCompiler(tree).run(); }

}  // namespace barkridge
