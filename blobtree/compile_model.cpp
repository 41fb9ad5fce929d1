#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "base/large_room.h"
#include "base/random.h"
#include "blobtree/contact.h"
#include "blobtree/field_model.h"
#include "blobtree/morton.h"
#include "blobtree/operator_bounds.h"
#include "blobtree/primitive_bounds.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

constexpr double kRounding = 1e-6;

bool is_primitive(const Node& node) { return node.children.empty(); }

// How deep a stack a node's evaluation needs when its children go by falling need. [Sethi and Ullman 1970]
std::vector<std::uint32_t> stack_needs(const BlobTree& tree) {
  std::vector<std::uint32_t> needs;
  reserve_large(needs, tree.nodes.size());
  needs.resize(tree.nodes.size(), 1);
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
    make_room();
    visit(tree_.root, kNoOperator, 0);
    while (!pending_.empty()) {
      const Task task = pending_.back();
      pending_.pop_back();
      task.first_waiting == kNoneWaiting ? visit(task.node, task.parent, task.rank)
                                         : place_primitives(task.first_waiting, task.parent);
    }
    unite_twins();
    write_primitives();
    finish();
    return model_;
  }

 private:
  static constexpr std::uint32_t kNoneWaiting = ~std::uint32_t{0};

  // Either a node to visit, or a sum whose other operands have their places, and the first of its primitives that wait
  // for theirs; a stack of them stands in for recursion.
  struct Task {
    NodeId node = 0;
    std::uint32_t parent = kNoOperator;
    std::uint8_t rank = 0;
    std::uint32_t first_waiting = kNoneWaiting;
  };

  void find_units() {
    model_->support = supports_[tree_.root];
    const Vec3 size = model_->support.empty() ? Vec3(1) : model_->support.hi - model_->support.lo;
    const double largest = std::max({size.x, size.y, size.z});
    int exponent = 0;
    if (largest > 0 && std::isfinite(largest)) std::frexp(largest, &exponent);
    model_->units.scale = std::ldexp(1.0, -exponent);
    // Coarse enough for most batches to have one origin, fine enough for the thinnest twig and the finest noise.
    constexpr double kThinnestRadii = 128, kFinestWaves = 16;
    const double wanted = std::min(kThinnestRadii * thinnest_radius(tree_), kFinestWaves * finest_wavelength(tree_)) *
                          model_->units.scale;
    model_->units.origin_spacing = std::exp2(std::round(std::log2(std::clamp(wanted, 0x1p-14, 0x1p-4))));
  }

  // Whether any field can be negative: then a missing operand of a union or a contact, which is zero, counts.
  void find_negatives() {
    for (const Node& node : tree_.nodes) has_negatives_ = has_negatives_ || std::holds_alternative<Negative>(node.what);
  }

  // For every operator and a sum around every operand of it that is a primitive or a sum; and for all primitives.
  void make_room() {
    const auto stands_in_sum = [&](NodeId id) {
      return is_primitive(tree_.nodes[id]) || std::holds_alternative<Sum>(tree_.nodes[id].what);
    };
    std::size_t operators = 1, primitives = 0;
    for (const Node& node : tree_.nodes) {
      if (is_primitive(node)) {
        ++primitives;
        has_others_ = has_others_ || !is_cone(node);
        continue;
      }
      if (std::holds_alternative<Sum>(node.what)) continue;
      operators +=
          1 + static_cast<std::size_t>(std::count_if(node.children.begin(), node.children.end(), stands_in_sum));
      if (std::holds_alternative<Negative>(node.what)) operators += node.children.size() - 1;
      if (std::holds_alternative<Difference>(node.what)) ++operators;
    }
    reserve_large(model_->operators, operators);
    reserve_large(model_->sums, primitives);
    reserve_large(nodes_, primitives);
  }

  std::uint32_t add_operator(Op op, std::size_t operand_count, std::size_t index, std::uint32_t parent,
                             std::uint8_t rank) {
    FieldOperator node{op};
    node.is_kept = op == Op::kNegate || op == Op::kDisplace || op == Op::kRicci || op == Op::kIntersection ||
                   op == Op::kDifference || op == Op::kEnterWarp ||
                   (has_negatives_ && (op == Op::kUnion || op == Op::kContact));
    node.rank = rank;
    node.index = static_cast<std::uint32_t>(index);
    node.operand_count = static_cast<std::uint32_t>(operand_count);
    node.parent = parent;
    if (parent != kNoOperator) {
      const FieldOperator& above = model_->operators[parent];
      node.depth = above.depth + 1;
      node.kept_above = above.is_kept ? parent : above.kept_above;
      node.kept_rank = above.is_kept ? rank : above.kept_rank;
      node.gain = above.gain;
    }
    if (op == Op::kDisplace)
      node.gain *= static_cast<float>((1 + model_->displacements[index].amount) * (1 + kRounding));
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
    const std::size_t first_waiting = waiting_.size();
    nested_.assign(1, id);
    others_.clear();
    while (!nested_.empty()) {
      const NodeId next = nested_.back();
      nested_.pop_back();
      const Node& node = tree_.nodes[next];
      if (is_primitive(node)) {
        waiting_.push_back(next);
      } else if (std::holds_alternative<Sum>(node.what)) {
        nested_.insert(nested_.end(), node.children.rbegin(), node.children.rend());
      } else {
        others_.push_back(next);
      }
    }
    sort_in_space(std::span(waiting_).subspan(first_waiting));
    pending_.push_back({0, sum, 0, static_cast<std::uint32_t>(first_waiting)});
    visit_later(others_, sum);
  }

  void sort_in_space(std::span<NodeId> primitives) const {
    constexpr std::size_t kFew = 8;
    if (primitives.size() <= kFew) return;
    const std::vector<NodeId> unsorted(primitives.begin(), primitives.end());
    const std::vector<std::uint32_t> order =
        order_along_curve(unsorted.size(), [&](std::size_t i) { return supports_[unsorted[i]]; });
    for (std::size_t i = 0; i < order.size(); ++i) primitives[i] = unsorted[order[i]];
  }

  // Pushed last is visited first: the child of the greatest need.
  void visit_later(std::span<const NodeId> children, std::uint32_t parent, std::uint8_t rank = 0) {
    const auto count = static_cast<std::ptrdiff_t>(children.size());
    for (const NodeId child : children) pending_.push_back({child, parent, rank});
    if (count < 2) return;
    std::stable_sort(pending_.end() - count, pending_.end(),
                     [&](const Task& a, const Task& b) { return needs_[a.node] < needs_[b.node]; });
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
    const auto [known, is_new] =
        shapes_.emplace(std::pair(contact.shape.width, contact.shape.swelling), model_->contacts.size());
    if (is_new) model_->contacts.push_back(contact.shape);
    model_->is_below_sum = model_->is_below_sum && is_below_sum(contact.shape);
    visit_commutative(Op::kContact, id, parent, rank, known->second);
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
    visit_later(std::span(children).subspan(1), taken);
    pending_.push_back({children[0], difference, 0});
  }

  void visit_operator(const Displacement& displacement, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    model_->displacements.push_back(displacement);
    const std::uint32_t node = add_operator(Op::kDisplace, 1, model_->displacements.size() - 1, parent, rank);
    model_->warps_noise = model_->warps_noise || is_warped(*model_, node);
    pending_.push_back({tree_.nodes[id].children[0], node, 0});
  }

  void visit_warp(Warp warp, NodeId id, std::uint32_t parent, std::uint8_t rank) {
    model_->warps.push_back(std::move(warp));
    warp_nodes_.push_back(id);
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

  void place_primitives(std::uint32_t first_waiting, std::uint32_t sum) {
    for (std::size_t i = first_waiting; i < waiting_.size(); ++i) {
      nodes_.push_back(waiting_[i]);
      model_->sums.push_back(sum);
    }
    waiting_.resize(first_waiting);
  }

  // Equal cones in different operands of a union are one primitive in two places.
  void unite_twins() {
    const std::vector<std::uint32_t> twins = find_twins();
    if (twins.empty()) {
      model_->nodes = std::move(nodes_);
      return;
    }
    for (std::uint32_t place = 0; place < nodes_.size(); ++place) {
      const std::uint32_t twin = twins[place];
      if (twin < place) continue;
      model_->places.push_back({place, twin});
      model_->nodes.push_back(twin == kNoPlace ? nodes_[place] : std::min(nodes_[place], nodes_[twin]));
    }
  }

  // By place; empty if there are none.
  std::vector<std::uint32_t> find_twins() const {
    if (std::none_of(model_->operators.begin(), model_->operators.end(),
                     [](const FieldOperator& node) { return node.op == Op::kUnion && node.operand_count > 1; })) {
      return {};
    }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;  // and places
    resize_large(keys, nodes_.size());
    tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
      keys[i] = {key_of(tree_.nodes[nodes_[i]]), static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(keys);
    std::vector<std::uint32_t> twins;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
      const auto [key, place] = keys[i];
      const auto [next_key, next] = keys[i + 1];
      if (key != next_key || !are_twins(place, next)) continue;
      if (twins.empty()) twins.assign(nodes_.size(), kNoPlace);
      twins[place] = next;
      twins[next] = place;
      ++i;
    }
    return twins;
  }

  static std::uint64_t key_of(const Node& node) {
    return std::visit(
        [](const auto& what) -> std::uint64_t {
          const auto key = [](double x) { return std::bit_cast<std::uint64_t>(x); };
          if constexpr (requires { what.base_radius; }) {
            return hash_keys(key(what.base.x), key(what.base.y), key(what.base.z), key(what.tip.x), key(what.tip.y),
                             key(what.tip.z), key(what.base_radius), key(what.tip_radius));
          }
          return 0;
        },
        node.what);
  }

  bool are_twins(std::uint32_t a, std::uint32_t b) const {
    const Node& node = tree_.nodes[nodes_[a]];
    if (!is_cone(node) || node != tree_.nodes[nodes_[b]]) return false;
    const std::vector<std::uint32_t>& sums = model_->sums;
    const std::uint32_t above = common_ancestor(sums[a], sums[b]);
    return model_->operators[above].op == Op::kUnion && !only_takes_away(*model_, sums[a]) &&
           !only_takes_away(*model_, sums[b]) && model_->operators[sums[a]].gain == model_->operators[sums[b]].gain &&
           warps_below(above, sums[a]) == warps_below(above, sums[b]);
  }

  // What the warps between two operators are in the tree, from the lowest on.
  std::vector<decltype(Node::what)> warps_below(std::uint32_t above, std::uint32_t sum) const {
    std::vector<decltype(Node::what)> warps;
    const std::vector<FieldOperator>& operators = model_->operators;
    for (std::uint32_t at = operators[sum].kept_above;
         at != kNoOperator && operators[at].depth > operators[above].depth; at = operators[at].kept_above) {
      if (operators[at].op == Op::kEnterWarp) warps.push_back(tree_.nodes[warp_nodes_[operators[at].index]].what);
    }
    return warps;
  }

  static bool is_cone(const Node& node) {
    return std::holds_alternative<Cone>(node.what) || std::holds_alternative<FadedCone>(node.what);
  }

  template <typename Shape>
  void keep_if_other(const Shape& shape, std::size_t number, NodeId id) {
    if constexpr (std::is_constructible_v<std::variant<Disc, Ring, Polygon>, Shape>) {
      model_->others.push_back({static_cast<std::uint32_t>(number), shape, supports_[id]});
    }
  }

  // All have their places: what stands there depends on nothing else.
  void write_primitives() {
    for (std::size_t i = 0; has_others_ && i < model_->nodes.size(); ++i) {
      const NodeId id = model_->nodes[i];
      std::visit([&](const auto& what) { keep_if_other(what, i, id); }, tree_.nodes[id].what);
    }
    resize_large(model_->cones, model_->nodes.size());
    resize_large(model_->kinds, model_->nodes.size());
    resize_large(boxes_, model_->nodes.size());
    tbb::parallel_for(std::size_t{0}, model_->nodes.size(), [&](std::size_t i) {
      const NodeId id = model_->nodes[i];
      const Node& node = tree_.nodes[id];
      if (const Cone* cone = std::get_if<Cone>(&node.what)) {
        model_->cones[i] = record_of(*cone, model_->units.scale);
      } else if (const FadedCone* faded = std::get_if<FadedCone>(&node.what)) {
        model_->cones[i] = record_of(*faded, model_->units.scale);
        model_->kinds[i] = kind_of_faded(model_->cones[i]);
      }
      boxes_[i] = box_in_world(*model_, model_->sum_of(static_cast<std::uint32_t>(i)), [&](const Warp::Framed* frame) {
        return frame ? support_in_frame(node, supports_[id], *frame) : supports_[id];
      });
    });
  }

  std::uint32_t common_ancestor(std::uint32_t a, std::uint32_t b) const {
    const std::vector<FieldOperator>& operators = model_->operators;
    while (a != b) {
      std::uint32_t& deeper = operators[a].depth < operators[b].depth ? b : a;
      deeper = operators[deeper].parent;
    }
    return a;
  }

  void finish() {
    FieldModel& model = *model_;
    model.supports = BoxHierarchy(boxes_);
    std::vector<std::uint32_t> ancestors;
    resize_large(ancestors, std::max<std::size_t>(model.sums.size(), 1) - 1);
    tbb::parallel_for(std::size_t{0}, ancestors.size(),
                      [&](std::size_t i) { ancestors[i] = common_ancestor(model.sums[i], model.sums[i + 1]); });
    model.ancestors.build(std::move(ancestors), model.operators);
    model.sums.shrink_to_fit();
    model.nodes.shrink_to_fit();
    model.places.shrink_to_fit();
    model.operators.shrink_to_fit();
    model.warps.shrink_to_fit();
    model.displacements.shrink_to_fit();
    model.takes_away = std::any_of(model.operators.begin(), model.operators.end(), [](const FieldOperator& node) {
      return node.op == Op::kNegate || node.op == Op::kDifference;
    });
    // No primitive's field exceeds 1, and no contact adds more than that for each of its children.
    float gain = 1;
    for (const FieldOperator& node : model.operators) gain = std::max(gain, node.gain);
    const double most = static_cast<double>(gain) * static_cast<double>(model.cones.size());
    model.bounds = {{has_negatives_ ? -most : 0, most}, std::numeric_limits<double>::infinity()};
  }

  const BlobTree& tree_;
  std::vector<std::uint32_t> needs_;
  std::vector<Box> supports_;
  bool has_negatives_ = false;
  bool has_others_ = false;                                  // primitives that are no cones
  std::map<std::pair<double, double>, std::size_t> shapes_;  // contacts by width and swelling: a tree has but a few
  std::vector<Task> pending_;
  std::vector<NodeId> waiting_;          // primitives of the sums whose other operands find their places
  std::vector<NodeId> nested_, others_;  // room for `visit_sum`
  std::vector<NodeId> nodes_;            // by place
  std::vector<NodeId> warp_nodes_;       // by warp
  std::vector<Box> boxes_;               // by primitive
  std::shared_ptr<FieldModel> model_;
};

}  // namespace

std::shared_ptr<const FieldModel> compile_model(const BlobTree& tree) { return ModelCompiler(tree).run(); }

}  // namespace barkridge
