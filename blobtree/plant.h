#pragma once
// A skeleton on its way to a BlobTree: what every internode's primitive must know of its neighbours.

#include <span>
#include <variant>
#include <vector>

#include "blobtree/axes.h"
#include "blobtree/from_skeleton.h"
#include "blobtree/joint_plan.h"

namespace barkridge {

/// What an internode's primitive must know of its neighbours. Shed branches are none.
struct Neighbourhood {
  const Internode* parent = nullptr;
  bool shares_base = false;  ///< with other children of its parent
  std::size_t child_count = 0;
  double thickest_child = 0;  ///< base radius
};

class Plant {
 public:
  /// All must outlive it. `arcs` may be empty. Throws `InputError` for marks at wrong internodes and for numbers of the
  /// displacement outside their ranges.
  Plant(const Skeleton& skeleton, std::span<const Arc> arcs, const TreeOptions& options);

  const Skeleton& skeleton() const { return skeleton_; }
  const TreeOptions& options() const { return options_; }
  std::size_t size() const { return skeleton_.internodes.size(); }
  const Internode& internode(std::size_t i) const { return skeleton_.internodes[i]; }
  bool has_arcs() const { return !arcs_.empty(); }
  bool is_displaced() const { return options_.displacement.amount > 0; }
  Arc arc(std::size_t i) const { return arcs_.empty() ? Arc{} : arcs_[i]; }
  /// All children, shed ones too; those of index `size()` are the roots.
  std::span<const InternodeId> children_of(std::size_t i) const {
    return std::span(table_.children).subspan(table_.first[i], table_.first[i + 1] - table_.first[i]);
  }
  Neighbourhood neighbourhood_of(std::size_t i) const;
  /// Whether the larger of the internode's field and that of what it carries counts, instead of their sum.
  bool is_united(std::size_t i) const { return !plans_.empty() && plans_[i].is_united; }

  /// Null where there is none.
  const CutEnd* cut_end_of(std::size_t i) const;
  const Scar* scar_of(std::size_t i) const;

  /// The internode's primitive before it is bent. That of a cut end goes on straight past the cut, by
  /// `length_past_cut`, for the cut to take away; what is shed has none.
  std::variant<Cone, FadedCone> primitive(std::size_t i) const;
  /// The same as a node, perhaps under a bend and a displacement. Adds at most three nodes.
  NodeId add_primitive(BlobTree& tree, std::size_t i) const;

 private:
  void plan_displacement();
  double displacement_of(const Internode& internode) const;

  const Skeleton& skeleton_;
  std::span<const Arc> arcs_;
  const TreeOptions& options_;
  ChildTable table_;
  std::vector<JointPlan> plans_;  // by internode, of faded joints
  SolidNoise noise_;              // of displacements
  double furrowed_radius_ = 0;
};

/// How far past a cut its internode's axis goes on, so that neither the tilted face nor the splinters meet its round
/// end.
double length_past_cut(const Internode& internode, const Vec3& axis, const CutEnd& end);

}  // namespace barkridge
