#include "blobtree/field_program.h"

#include <algorithm>

#include "blobtree/operator_bounds.h"
#include "blobtree/primitive_bounds.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

// How deep a stack a node's evaluation needs when its children go by falling need. [Sethi and Ullman 1970]
std::vector<std::uint32_t> stack_needs(const BlobTree& tree) {
  std::vector<std::uint32_t> needs(tree.nodes.size(), 1);
  std::vector<std::uint32_t> of_children;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    of_children.clear();
    for (const NodeId child : tree.nodes[i].children) of_children.push_back(needs[child]);
    std::sort(of_children.begin(), of_children.end(), std::greater<>());
    for (std::uint32_t k = 0; k < of_children.size(); ++k) needs[i] = std::max(needs[i], of_children[k] + k);
  }
  return needs;
}

class Compiler {
 public:
  explicit Compiler(const BlobTree& tree)
      : tree_(tree), needs_(stack_needs(tree)), data_(std::make_shared<FieldProgramData>()) {}

  FieldProgram run() {
    if (tree_.nodes.empty()) return {data_, {}};
    pending_.push_back({tree_.root});
    while (!pending_.empty()) {
      const Task task = pending_.back();
      pending_.pop_back();
      if (task.is_instruction) {
        code_.push_back(task.instruction);
      } else {
        std::visit([&](const auto& what) { visit(what, tree_.nodes[task.node].children); },
                   tree_.nodes[task.node].what);
      }
    }
    return {data_, std::move(code_)};
  }

 private:
  // Either a node to visit or an instruction to write; a stack of them stands in for recursion.
  struct Task {
    NodeId node = 0;
    bool is_instruction = false;
    FieldInstruction instruction{};
  };

  void later(Op op, std::size_t count, std::size_t index = 0) {
    pending_.push_back({0, true, {op, static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(index)}});
  }
  void now(Op op, std::size_t index) { code_.push_back({op, 0, static_cast<std::uint32_t>(index)}); }

  // Pushed last is visited first: the child of the greatest need.
  void visit_children_later(std::vector<NodeId> children) {
    std::stable_sort(children.begin(), children.end(), [&](NodeId a, NodeId b) { return needs_[a] < needs_[b]; });
    for (const NodeId child : children) pending_.push_back({child});
  }

  void visit(const Cone& cone, const std::vector<NodeId>&) {
    const Vec3 ab = cone.tip - cone.base;
    const double length = glm::length(ab);
    FieldProgramData::ConeData data{cone, Vec3(0, 1, 0), 0, 0, support_of(cone)};
    if (length > 0) {
      data.axis = ab / length;
      data.length = length;
      data.taper = (cone.tip_radius - cone.base_radius) / length;
    } else {
      data.cone.base_radius = std::max(cone.base_radius, cone.tip_radius);
    }
    now(Op::kCone, data_->cones.size());
    data_->cones.push_back(data);
  }
  void visit(const FadedCone& cone, const std::vector<NodeId>&) {
    now(Op::kFadedCone, data_->faded_cones.size());
    data_->faded_cones.push_back({cone, FadedConeFrame(cone), support_of(cone)});
  }
  template <typename Primitive>
  requires std::is_constructible_v<std::variant<Disc, Ring, Polygon>, Primitive>
  void visit(const Primitive& primitive, const std::vector<NodeId>&) {
    now(Op::kOther, data_->others.size());
    data_->others.push_back({primitive, support_of(primitive)});
  }

  void visit_commutative(Op op, const std::vector<NodeId>& children, std::size_t index = 0) {
    later(op, children.size(), index);
    visit_children_later(children);
  }
  void visit(const Sum&, const std::vector<NodeId>& children) { visit_commutative(Op::kSum, children); }
  void visit(const Union&, const std::vector<NodeId>& children) { visit_commutative(Op::kUnion, children); }
  void visit(const Intersection&, const std::vector<NodeId>& children) {
    visit_commutative(Op::kIntersection, children);
  }
  void visit(const Ricci& ricci, const std::vector<NodeId>& children) {
    visit_commutative(Op::kRicci, children, data_->exponents.size());
    data_->exponents.push_back(ricci.exponent);
  }
  void visit(const Contact& contact, const std::vector<NodeId>& children) {
    // A tree from a skeleton has one shape for all its contacts.
    if (data_->contacts.empty() || !(data_->contacts.back() == contact.shape)) data_->contacts.push_back(contact.shape);
    visit_commutative(Op::kContact, children, data_->contacts.size() - 1);
  }
  void visit(const Negative&, const std::vector<NodeId>& children) {
    later(Op::kSum, children.size());
    for (std::size_t i = children.size(); i-- > 1;) {
      later(Op::kNegate, 1);
      pending_.push_back({children[i]});
    }
    pending_.push_back({children[0]});
  }
  void visit(const Difference&, const std::vector<NodeId>& children) {
    later(Op::kDifference, 2);
    later(Op::kUnion, children.size() - 1);
    visit_children_later({children.begin() + 1, children.end()});
    pending_.push_back({children[0]});
  }

  void visit_warp(const Warp& warp, const std::vector<NodeId>& children) {
    now(Op::kEnterWarp, data_->warps.size());
    later(Op::kLeaveWarp, 1, data_->warps.size());
    data_->warps.push_back(warp);
    pending_.push_back({children[0]});
  }
  void visit(const Bend& bend, const std::vector<NodeId>& children) {
    if (supports_.empty()) supports_ = supports_of(tree_);
    visit_warp(Warp(bend, supports_[children[0]]), children);
  }
  template <typename W>
  requires std::is_constructible_v<Warp, W>
  void visit(const W& warp, const std::vector<NodeId>& children) { visit_warp(Warp(warp), children); }

  const BlobTree& tree_;
  std::vector<std::uint32_t> needs_;
  std::vector<Box> supports_;
  std::vector<Task> pending_;
  std::shared_ptr<FieldProgramData> data_;
  std::vector<FieldInstruction> code_;
};

}  // namespace

FieldProgramDepth depth_of(const FieldProgram& program) {
  std::size_t fields = 0, warps = 0;
  FieldProgramDepth deepest;
  for (const FieldInstruction& instruction : program.code) {
    switch (instruction.op) {
      case Op::kZero:
      case Op::kCone:
      case Op::kFadedCone:
      case Op::kOther:
        ++fields;
        break;
      case Op::kNegate:
        break;
      case Op::kEnterWarp:
        ++warps;
        break;
      case Op::kLeaveWarp:
        --warps;
        break;
      default:
        fields -= instruction.count - 1;
    }
    deepest.fields = std::max(deepest.fields, fields);
    deepest.warps = std::max(deepest.warps, warps);
  }
  return deepest;
}

FieldProgram compile_program(const BlobTree& tree) { return Compiler(tree).run(); }

}  // namespace barkridge
