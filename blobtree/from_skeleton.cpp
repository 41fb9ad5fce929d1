#include "blobtree/from_skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <tuple>

#include "base/error.h"
#include "base/large_room.h"
#include "blobtree/axes.h"
#include "blobtree/blending_groups.h"
#include "blobtree/missing_organs.h"
#include "blobtree/plant.h"

namespace barkridge {

namespace {

// Nodes that are to be summed: a subtree before anything but a sum has needed it as one node. Each is linked to the
// next, so that rows of any length become one at no cost.
struct Summands {
  NodeId first = 0, last = 0;
  std::uint32_t count = 0;
};

class TreeBuilder {
 public:
  explicit TreeBuilder(const Plant& plant) : plant_(plant) {
    resize_large(subtrees_, plant_.size());
    Carvings carvings = add_carvings(plant_, tree_);
    carvings_ = std::move(carvings.nodes);
    is_split_.resize(plant_.size());
    if (plant_.options().blending == BlendingKind::kConfined) is_split_ = ends_of_blending(plant_, carvings.touched);
    // A carving may need a sum, and is followed by no more than one operator.
    const std::size_t most = most_nodes() + tree_.nodes.size() + 2 * carvings_.size();
    reserve_large(tree_.nodes, most);
    resize_large(next_, most);
    resize_large(primitives_, plant_.size());
  }

  PlantTree run() {
    // Children before parents: the summands of a subtree move up the axis and become a node where branches touch, or
    // where blending ends: what meets at the tip of an internode is a group of its own then.
    auto carving = carvings_.begin();
    std::vector<NodeId> apart;
    for (std::size_t i = plant_.size(); i-- > 0;) {
      primitives_[i] = kNoNode;
      if (plant_.scar_of(i)) continue;
      Summands subtree = join(static_cast<InternodeId>(i), plant_.children_of(i));
      const NodeId internode = plant_.add_primitive(tree_, i);
      NodeId primitive = internode;
      while (!tree_.nodes[primitive].children.empty()) primitive = tree_.nodes[primitive].children[0];
      primitives_[i] = primitive;
      if (plant_.is_united(i) && subtree.count > 0) {
        const NodeId carried = as_node(subtree);
        subtree = single(tree_.add(Union{}, {internode, carried}));
      } else {
        append(subtree, single(internode));
      }
      const auto first = carving;
      while (carving != carvings_.end() && carving->internode == static_cast<InternodeId>(i)) ++carving;
      if (first != carving) carve(subtree, std::span(first, carving));
      if (is_split_[i]) {
        apart.push_back(as_node(subtree));
        subtree = single(plant_.add_primitive(tree_, i));
      }
      subtrees_[i] = subtree;
    }
    // Roots that start at one point are children of the ground there.
    std::map<std::tuple<double, double, double>, std::vector<InternodeId>> plants;
    for (const InternodeId root : plant_.children_of(plant_.size())) {
      const Vec3& base = plant_.internode(static_cast<std::size_t>(root)).base;
      plants[{base.x, base.y, base.z}].push_back(root);
    }
    for (const auto& [base, roots] : plants) {
      // A root by itself adds nothing to the group that it carries.
      if (roots.size() > 1 || !is_split_[static_cast<std::size_t>(roots.front())]) {
        apart.push_back(as_node(join(kNoInternode, roots)));
      }
    }
    if (apart.size() > 1)
      tree_.add(Union{}, std::move(apart));
    else if (apart.size() == 1)
      tree_.root = apart.front();
    return {std::move(tree_), std::move(primitives_), {}};
  }

 private:
  // A primitive and perhaps a bend and a displacement for every internode, and again with a sum where blending ends; a
  // union and a sum where it is united with what it carries; a contact where branches touch, and a sum for each of
  // several internodes; what joins the roots.
  std::size_t most_nodes() const {
    const std::size_t for_each = 1 + (plant_.has_arcs() ? 1 : 0) + (plant_.is_displaced() ? 1 : 0);
    std::size_t most = plant_.size() * for_each;
    for (std::size_t i = 0; i < plant_.size(); ++i) {
      most += (is_split_[i] ? for_each + 1 : 0) + (plant_.is_united(i) ? 2 : 0);
    }
    most += 3 * plant_.children_of(plant_.size()).size() + 1;
    if (plant_.options().junction == JunctionKind::kSmooth) return most;
    for (std::size_t i = 0; i < plant_.size(); ++i) {
      const auto children = plant_.children_of(i);
      if (children.size() < 2) continue;
      most += 1 + static_cast<std::size_t>(std::count_if(children.begin(), children.end(), [&](InternodeId child) {
                return !plant_.children_of(static_cast<std::size_t>(child)).empty();
              }));
    }
    return most;
  }

  static Summands single(NodeId node) { return {node, node, 1}; }

  void append(Summands& row, const Summands& more) {
    if (row.count == 0) {
      row = more;
    } else {
      next_[row.last] = more.first;
      row = {row.first, more.last, row.count + more.count};
    }
  }

  NodeId as_node(const Summands& summands) {
    if (summands.count == 1) return summands.first;
    std::vector<NodeId> nodes(summands.count);
    NodeId next = summands.first;
    for (NodeId& node : nodes) {
      node = next;
      next = next_[next];
    }
    return tree_.add(Sum{}, std::move(nodes));
  }

  // What branches that start at one point are together.
  Summands join(InternodeId carrier, std::span<const InternodeId> branches) {
    if (branches.size() > 1 && plant_.options().junction == JunctionKind::kRidge) {
      return join_by_contact(carrier, branches);
    }
    Summands all;
    for (const InternodeId branch : branches) {
      Summands subtree = subtrees_[static_cast<std::size_t>(branch)];
      if (subtree.count > all.count) std::swap(all, subtree);
      if (subtree.count > 0) append(all, subtree);
    }
    return all;
  }

  Summands join_by_contact(InternodeId carrier, std::span<const InternodeId> branches) {
    std::vector<InternodeId> standing;
    for (const InternodeId branch : branches) {
      if (subtrees_[static_cast<std::size_t>(branch)].count > 0) standing.push_back(branch);
    }
    if (standing.empty()) return {};
    if (standing.size() == 1) return subtrees_[static_cast<std::size_t>(standing[0])];
    std::vector<NodeId> nodes;
    nodes.reserve(standing.size());
    for (const InternodeId branch : standing) nodes.push_back(as_node(subtrees_[static_cast<std::size_t>(branch)]));
    const ContactShape shape =
        contact_shape_of(plant_.skeleton(), carrier, standing, plant_.options().ridge_rules, plant_.options().contact);
    return single(tree_.add(Contact{shape}, std::move(nodes)));
  }

  // What missing organs make of a subtree: first sums, then negative fields, then cuts.
  void carve(Summands& subtree, std::span<const Carving> carvings) {
    std::vector<NodeId> negatives{0}, subtracted{0};
    for (const Carving& carving : carvings) {
      if (carving.kind == Carving::Kind::kAdded) append(subtree, single(carving.node));
      if (carving.kind == Carving::Kind::kNegative) negatives.push_back(carving.node);
      if (carving.kind == Carving::Kind::kSubtracted) subtracted.push_back(carving.node);
    }
    const auto apply = [&](auto what, std::vector<NodeId>& children) {
      if (children.size() == 1) return;
      children[0] = as_node(subtree);
      subtree = single(tree_.add(what, std::move(children)));
    };
    apply(Negative{}, negatives);
    apply(Difference{}, subtracted);
  }

  const Plant& plant_;
  BlobTree tree_;
  std::vector<NodeId> primitives_;  // by internode
  std::vector<Carving> carvings_;
  std::vector<bool> is_split_;      // by internode: whether blending ends there
  std::vector<NodeId> next_;        // by node: what it is followed by among summands
  std::vector<Summands> subtrees_;  // by internode; none of what is shed
};

}  // namespace

PlantTree plant_from_skeleton(Skeleton skeleton, const TreeOptions& options) {
  check(options.contact);
  for (const RidgeRule& rule : options.ridge_rules) check(rule.contact);
  for (const Ridge& ridge : skeleton.ridges) {
    check(ContactShape{ridge.width, ridge.swelling, options.contact.allow_large_swelling});
  }
  if (!(0 <= options.round_turn_degrees && options.round_turn_degrees <= 180)) {
    throw InputError(
        fmt::format("round turn {} is outside its range: 0 <= round_turn_degrees <= 180", options.round_turn_degrees));
  }
  std::vector<Arc> arcs;
  if (shapes_axes(options)) {
    Axes axes = axes_of(skeleton, options);
    skeleton = std::move(axes.skeleton);
    arcs = std::move(axes.arcs);
  }
  PlantTree plant = TreeBuilder(Plant(skeleton, arcs, options)).run();
  plant.skeleton = std::move(skeleton);
  return plant;
}

BlobTree tree_from_skeleton(const Skeleton& skeleton, const TreeOptions& options) {
  return plant_from_skeleton(skeleton, options).tree;
}

}  // namespace barkridge
