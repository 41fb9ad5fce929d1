#include "subdivision/branches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/large_room.h"

namespace barkridge {

namespace {

// Squares of what lies farther out leave the range of single precision, in which meshes are.
constexpr double kFarthest = 1e18;

bool within_range(const Vec3& p) {
  return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
}

void check_internode(const Internode& internode, std::size_t id) {
  if (internode.parent != kNoInternode && (internode.parent < 0 || static_cast<std::size_t>(internode.parent) >= id)) {
    throw InputError(fmt::format("internode {} has parent {}: parents must come before children, which rules out loops",
                                 id, internode.parent));
  }
  if (!within_range(internode.base) || !within_range(internode.tip)) {
    throw InputError(fmt::format("internode {} has an end beyond {:g}: expected finite coordinates", id, kFarthest));
  }
  for (const double radius : {internode.base_radius, internode.tip_radius}) {
    if (!(radius > 0) || radius > kFarthest) {
      throw InputError(fmt::format("internode {} has radius {:g}: expected a finite one above 0", id, radius));
    }
  }
  if (!(glm::distance(internode.base, internode.tip) > 0)) {
    throw InputError(fmt::format("internode {} has no length", id));
  }
}

// The children that are attached to the internode, in order.
class Attached {
 public:
  explicit Attached(const Skeleton& skeleton) : skeleton_(skeleton), table_(child_table(skeleton)) {}

  bool operator()(InternodeId child) const {
    const Internode& internode = skeleton_.internodes[static_cast<std::size_t>(child)];
    if (internode.parent == kNoInternode) return false;
    const Internode& parent = skeleton_.internodes[static_cast<std::size_t>(internode.parent)];
    return glm::distance(internode.base, parent.tip) <= parent.tip_radius &&
           glm::distance(internode.tip, parent.tip) > 0;
  }

  // The internode that goes on with the branch of `id`, or none.
  InternodeId next(InternodeId id, BranchEnd end) const {
    InternodeId found = kNoInternode;
    double thickest = 0;
    int attached = 0;
    const auto row = static_cast<std::size_t>(id);
    for (std::uint32_t i = table_.first[row]; i < table_.first[row + 1]; ++i) {
      const InternodeId child = table_.children[i];
      if (!(*this)(child)) continue;
      ++attached;
      const Internode& internode = skeleton_.internodes[static_cast<std::size_t>(child)];
      if (end == BranchEnd::kAtTips && internode.order != skeleton_.internodes[row].order) continue;
      if (internode.base_radius > thickest) {
        thickest = internode.base_radius;
        found = child;
      }
    }
    return end == BranchEnd::kAtJoints && attached > 1 ? kNoInternode : found;
  }

 private:
  const Skeleton& skeleton_;
  ChildTable table_;
};

// Every branch's children, and how far from the root it starts.
void link(Branches& all, const std::vector<double>& start_on_parent) {
  for (const Branch& branch : all.branches) {
    if (branch.parent >= 0) ++all.branches[static_cast<std::size_t>(branch.parent)].child_count;
  }
  std::uint32_t room = 0;
  for (Branch& branch : all.branches) {
    branch.first_child = room;
    room += branch.child_count;
    branch.child_count = 0;
  }
  all.children.resize(room);
  for (std::size_t b = 0; b < all.branches.size(); ++b) {
    Branch& branch = all.branches[b];
    if (branch.parent >= 0) {
      Branch& parent = all.branches[static_cast<std::size_t>(branch.parent)];
      all.children[parent.first_child + parent.child_count++] = static_cast<std::uint32_t>(b);
      branch.path = parent.path + start_on_parent[b];
    }
    all.longest_path = std::max(all.longest_path, branch.path + all.axis(branch).back().along);
  }
}

}  // namespace

Branches branches_of(const Skeleton& skeleton, BranchEnd end) {
  const std::size_t count = skeleton.internodes.size();
  for (std::size_t i = 0; i < count; ++i) check_internode(skeleton.internodes[i], i);

  const Attached attached(skeleton);
  Branches all;
  std::vector<std::int32_t> branch_of(count, -1);
  std::vector<double> tip_along(count, 0);  // of every internode, on its branch
  std::vector<double> start_on_parent;      // of every branch
  reserve_large(all.nodes, count + count / 2);
  for (std::size_t start = 0; start < count; ++start) {
    if (branch_of[start] >= 0) continue;
    const Internode& first = skeleton.internodes[start];
    Branch branch;
    branch.first_node = static_cast<std::uint32_t>(all.nodes.size());
    const auto here = static_cast<std::int32_t>(all.branches.size());
    BranchNode node{first.base, first.base_radius, 0, static_cast<InternodeId>(start)};
    double on_parent = 0;
    if (attached(static_cast<InternodeId>(start))) {
      const auto parent = static_cast<std::size_t>(first.parent);
      branch.parent = branch_of[parent];
      node.position = skeleton.internodes[parent].tip;
      on_parent = tip_along[parent];
    }
    all.nodes.push_back(node);
    for (auto id = static_cast<InternodeId>(start); id != kNoInternode;) {
      const auto row = static_cast<std::size_t>(id);
      const Internode& internode = skeleton.internodes[row];
      const InternodeId next = attached.next(id, end);
      branch_of[row] = here;
      node.along += glm::distance(node.position, internode.tip);
      tip_along[row] = node.along;
      node.position = internode.tip;
      node.radius = internode.tip_radius;
      node.internode = id;
      if (next != kNoInternode) {
        node.radius = 0.5 * (node.radius + skeleton.internodes[static_cast<std::size_t>(next)].base_radius);
      }
      all.nodes.push_back(node);
      id = next;
    }
    branch.node_count = static_cast<std::uint32_t>(all.nodes.size()) - branch.first_node;
    all.branches.push_back(branch);
    start_on_parent.push_back(on_parent);
  }
  link(all, start_on_parent);
  return all;
}

AxisPoint point_on(std::span<const BranchNode> axis, double along) {
  const auto after = std::upper_bound(axis.begin() + 1, axis.end() - 1, along,
                                      [](double value, const BranchNode& node) { return value < node.along; });
  const BranchNode &a = *(after - 1), &b = *after;
  const double share = b.along > a.along ? std::clamp((along - a.along) / (b.along - a.along), 0.0, 1.0) : 1.0;
  return {glm::mix(a.position, b.position, share), glm::normalize(b.position - a.position),
          glm::mix(a.radius, b.radius, share), b.internode};
}

Vec3 tangent_at(std::span<const BranchNode> axis, std::size_t node) {
  const std::size_t before = node == 0 ? 0 : node - 1;
  const std::size_t after = std::min(node + 1, axis.size() - 1);
  const Vec3 leaving = glm::normalize(axis[after].position - axis[std::min(node, after - 1)].position);
  const Vec3 arriving = glm::normalize(axis[before + 1].position - axis[before].position);
  constexpr double kTurnsBack = 1e-6;
  const Vec3 sum = arriving + leaving;
  return glm::length(sum) > kTurnsBack ? glm::normalize(sum) : leaving;
}

std::vector<float> ages_of(std::span<const InternodeId> internodes, const Skeleton& skeleton) {
  std::int32_t newest = 0;
  for (const Internode& internode : skeleton.internodes) newest = std::max(newest, internode.birth_step);
  std::vector<float> ages;
  reserve_large(ages, internodes.size());
  for (const InternodeId id : internodes) {
    ages.push_back(static_cast<float>(newest - skeleton.internodes[static_cast<std::size_t>(id)].birth_step));
  }
  return ages;
}

}  // namespace barkridge
