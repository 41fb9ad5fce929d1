#include "subdivision/hull_graph.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/large_room.h"
#include "subdivision/hull_trim.h"

namespace barkridge {

namespace {

// Sides of a bend's ring come this near to each other where branches turn by 60 degrees.
constexpr double kLeastBendCosine = 0.5;
constexpr double kMostBendRatio = 2;  // of radii at a bend
// The part of a branch that its two ends' rings may take. A free end needs none.
constexpr double kTrimmedPart = 0.9;

template <typename Work>
void for_each_index(std::size_t count, Work work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) work(i);
  });
}

struct ByPlace {
  bool operator()(const Vec3& a, const Vec3& b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
};

class Builder {
 public:
  Builder(const Skeleton& skeleton, double thinnest_ring)
      : skeleton_(skeleton), thinnest_ring_(thinnest_ring), finest_(finest_length(skeleton)) {}

  HullGraph build() {
    set_nodes();
    dirty_.assign(graph_.positions.size(), 1);
    do {
      set_children();
      for_each_index(graph_.positions.size(), [&](std::size_t node) {
        if (dirty_[node]) trim(node);
      });
    } while (merge_misfits());
    return std::move(graph_);
  }

 private:
  // A node a tip, and one for every place where roots begin.
  void set_nodes() {
    const std::vector<Internode>& internodes = skeleton_.internodes;
    const std::size_t count = internodes.size();
    reserve_large(graph_.positions, count + 1);
    for (const Internode& internode : internodes) graph_.positions.push_back(internode.tip);
    resize_large(graph_.up, count);
    resize_large(graph_.base_radii, count);
    resize_large(graph_.tip_radii, count);
    graph_.base_trims.resize(count);
    graph_.tip_trims.resize(count);
    graph_.gone.resize(count, 0);
    std::map<Vec3, std::uint32_t, ByPlace> bases;
    for (std::size_t i = 0; i < count; ++i) {
      const Internode& internode = internodes[i];
      graph_.base_radii[i] = std::max(internode.base_radius, finest_);
      graph_.tip_radii[i] = std::max(internode.tip_radius, finest_);
      if (begins_at_parent(internode)) {
        graph_.up[i] = static_cast<std::uint32_t>(internode.parent);
        continue;
      }
      const auto [base, is_new] = bases.emplace(internode.base, static_cast<std::uint32_t>(graph_.positions.size()));
      if (is_new) graph_.positions.push_back(internode.base);
      graph_.up[i] = base->second;
    }
  }

  bool begins_at_parent(const Internode& internode) const {
    if (internode.parent == kNoInternode) return false;
    const Internode& parent = skeleton_.internodes[static_cast<std::size_t>(internode.parent)];
    return glm::distance(internode.base, parent.tip) <= std::max(parent.tip_radius, finest_);
  }

  void set_children() {
    const std::size_t nodes = graph_.positions.size();
    graph_.first.assign(nodes + 1, 0);
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      if (!graph_.gone[i]) ++graph_.first[graph_.up[i] + 1];
    }
    for (std::size_t i = 0; i < nodes; ++i) graph_.first[i + 1] += graph_.first[i];
    graph_.children.resize(graph_.first[nodes]);
    std::vector<std::uint32_t> next(graph_.first.begin(), graph_.first.end() - 1);
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      if (!graph_.gone[i]) graph_.children[next[graph_.up[i]]++] = static_cast<std::uint32_t>(i);
    }
  }

  std::size_t child_count(std::size_t node) const { return graph_.first[node + 1] - graph_.first[node]; }
  bool is_free(std::size_t node) const { return child_count(node) == (graph_.is_base(node) ? 1u : 0u); }
  double length(std::size_t branch) const {
    return glm::distance(graph_.positions[branch], graph_.positions[graph_.up[branch]]);
  }

  // Away from the node that is one of the branch's two; any direction for a branch that has none and will go.
  HullBranch seen_from(std::size_t node, std::size_t branch) const {
    const std::size_t far = branch == node ? graph_.up[branch] : branch;
    const double long_is = length(branch);
    HullBranch seen;
    seen.radius = branch == node ? graph_.tip_radii[branch] : graph_.base_radii[branch];
    seen.room = std::max(kTrimmedPart * long_is * (is_free(far) ? 1 : 0.5), finest_);
    if (long_is > finest_) seen.direction = (graph_.positions[far] - graph_.positions[node]) / long_is;
    return seen;
  }

  HullTrim& trim_of(std::size_t node, std::size_t branch) {
    return branch == node ? graph_.tip_trims[branch] : graph_.base_trims[branch];
  }

  void trim(std::size_t node) {
    std::vector<std::uint32_t> numbers;
    if (!graph_.is_base(node)) {
      if (graph_.gone[node]) return;
      numbers.push_back(static_cast<std::uint32_t>(node));
    }
    for (std::size_t i = graph_.first[node]; i < graph_.first[node + 1]; ++i) numbers.push_back(graph_.children[i]);
    if (numbers.size() == 1) trim_of(node, numbers[0]) = {};
    if (numbers.size() < 2) return;
    std::vector<HullBranch> branches;
    for (const std::uint32_t branch : numbers) branches.push_back(seen_from(node, branch));
    if (!graph_.is_base(node) && numbers.size() == 2 && is_bend(branches[0], branches[1])) {
      const double half_sine =
          std::sqrt(std::max(0.0, (1 + glm::dot(branches[0].direction, branches[1].direction)) / 2));
      for (std::size_t i = 0; i < 2; ++i) {
        trim_of(node, numbers[i]) = {HullEnd::kBend, half_sine * branches[i].radius, 0, 0};
      }
      return;
    }
    const std::vector<HullCone> cones = hull_cones(branches);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      trim_of(node, numbers[i]) = {HullEnd::kJoint, branches[i].radius / std::tan(cones[i].angle), cones[i].angle,
                                   cones[i].gap};
    }
  }

  static bool is_bend(const HullBranch& a, const HullBranch& b) {
    return -glm::dot(a.direction, b.direction) >= kLeastBendCosine && a.radius <= kMostBendRatio * b.radius &&
           b.radius <= kMostBendRatio * a.radius;
  }

  struct Misfit {
    double scale, length;
    std::uint32_t branch;
    bool operator<(const Misfit& other) const {
      return std::tie(scale, length, other.branch) < std::tie(other.scale, other.length, branch);
    }
  };

  // Returns whether there were any. Marks the nodes that have to be trimmed anew.
  bool merge_misfits() {
    std::vector<Misfit> misfits;
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      if (graph_.gone[i]) continue;
      const double long_is = length(i);
      const double scale = long_is <= 4 * finest_ ? -1 : ring_scale(graph_, i);
      if (scale < thinnest_ring_) misfits.push_back({scale, long_is, static_cast<std::uint32_t>(i)});
    }
    std::sort(misfits.begin(), misfits.end());
    // Of a joint's branches that end freely some may go at once; otherwise what went changes what its neighbours need.
    std::vector<std::uint32_t> taken(graph_.positions.size(), 0);
    for (const Misfit& misfit : misfits) {
      const std::uint32_t branch = misfit.branch, up = graph_.up[branch];
      const std::size_t most = child_count(branch) > 0 ? 0 : child_count(up) / 8;
      if (taken[up] > most || taken[branch] > 0) continue;
      ++taken[up];
      ++taken[branch];
      graph_.gone[branch] = 1;
    }
    if (!misfits.empty()) move_children();
    return !misfits.empty();
  }

  void move_children() {
    std::fill(dirty_.begin(), dirty_.end(), 0);
    const auto survivor = [&](std::uint32_t node) {
      return !graph_.is_base(node) && graph_.gone[node] ? graph_.up[node] : node;
    };
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      const std::uint32_t up = survivor(graph_.up[i]);
      if (up == graph_.up[i] && !graph_.gone[i]) continue;
      graph_.up[i] = up;
      dirty_[i] = dirty_[up] = 1;
    }
    // What a neighbour's end is, and where, decides how much room there is.
    std::vector<std::uint8_t> changed = dirty_;
    for (std::size_t i = 0; i < graph_.branches(); ++i) {
      if (graph_.gone[i]) continue;
      if (changed[i]) dirty_[graph_.up[i]] = 1;
      if (changed[graph_.up[i]]) dirty_[i] = 1;
    }
  }

  const Skeleton& skeleton_;
  const double thinnest_ring_;
  const double finest_;
  HullGraph graph_;
  std::vector<std::uint8_t> dirty_;  // nodes to be trimmed
};

}  // namespace

double ring_scale(const HullGraph& graph, std::size_t branch) {
  const HullTrim &base = graph.base_trims[branch], &tip = graph.tip_trims[branch];
  const double length = glm::distance(graph.positions[branch], graph.positions[graph.up[branch]]);
  double scale = std::min(1.0, kTrimmedPart * length / (base.offset + tip.offset));
  // A ring of radius `r` at `offset` from one end lies in the cone about the other end if
  // `scale r <= (length - scale offset) tan(angle)`.
  const auto keep_to_cone = [&](double radius, double offset, double angle) {
    scale = std::min(scale, length * std::tan(angle) / (radius + offset * std::tan(angle)));
  };
  if (base.end == HullEnd::kJoint && tip.end == HullEnd::kJoint) {
    keep_to_cone(graph.base_radii[branch], base.offset, tip.angle);
    keep_to_cone(graph.tip_radii[branch], tip.offset, base.angle);
  }
  return scale;
}

double finest_length(const Skeleton& skeleton) {
  double largest = 0;
  for (const Internode& internode : skeleton.internodes) {
    for (const Vec3& p : {internode.base, internode.tip}) {
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  return 8 * std::numeric_limits<float>::epsilon() * largest;
}

HullGraph hull_graph(const Skeleton& skeleton, double thinnest_ring) {
  return Builder(skeleton, thinnest_ring).build();
}

}  // namespace barkridge
