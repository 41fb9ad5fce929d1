#include "scene/model_statistics.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace barkridge {

namespace {

bool is_primitive(const Node& node) {
  return std::holds_alternative<Cone>(node.what) || std::holds_alternative<FadedCone>(node.what) ||
         std::holds_alternative<Disc>(node.what) || std::holds_alternative<Ring>(node.what) ||
         std::holds_alternative<Polygon>(node.what);
}

void count_junctions(const Skeleton& skeleton, ModelStatistics& counts) {
  const ChildTable table = child_table(skeleton);
  for (std::size_t i = 0; i < skeleton.internodes.size(); ++i) {
    if (table.first[i + 1] - table.first[i] > 1) ++counts.junctions;
  }
  std::map<std::tuple<double, double, double>, int> roots_at;
  const std::size_t roots = skeleton.internodes.size();
  for (std::size_t i = table.first[roots]; i < table.first[roots + 1]; ++i) {
    const Vec3& base = skeleton.internodes[static_cast<std::size_t>(table.children[i])].base;
    if (++roots_at[{base.x, base.y, base.z}] == 2) ++counts.junctions;
  }
}

void count_tree(const BlobTree& tree, ModelStatistics& counts) {
  // From the root down, for parents come after their children; depth 0 marks what the root does not reach.
  std::vector<std::size_t> depth(tree.nodes.size(), 0);
  if (!depth.empty()) depth[tree.root] = 1;
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    if (depth[i] == 0) continue;
    const Node& node = tree.nodes[i];
    ++counts.tree_nodes;
    if (is_primitive(node)) ++counts.primitives;
    counts.tree_depth = std::max(counts.tree_depth, depth[i]);
    for (const NodeId child : node.children) depth[child] = depth[i] + 1;
  }
}

}  // namespace

ModelStatistics statistics(const Model& model) {
  ModelStatistics counts;
  counts.internodes = model.skeleton.internodes.size();
  counts.organs = model.skeleton.organs.size();
  counts.dropped_internodes = model.skeleton.dropped_internodes;
  count_junctions(model.skeleton, counts);
  count_tree(model.tree, counts);
  counts.bytes = model.skeleton.internodes.capacity() * sizeof(Internode) +
                 model.skeleton.organs.capacity() * sizeof(Organ) + model.tree.nodes.capacity() * sizeof(Node);
  for (const Node& node : model.tree.nodes) counts.bytes += node.children.capacity() * sizeof(NodeId);
  return counts;
}

}  // namespace barkridge
