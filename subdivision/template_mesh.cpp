#include "subdivision/template_mesh.h"

#include "subdivision/branches.h"
#include "subdivision/frames.h"
#include "subdivision/joint_plan.h"
#include "subdivision/stem_builder.h"

namespace barkridge {

namespace {

// Builds all branches, each from the ring that the joint before it left.
class TemplateDresser {
 public:
  TemplateDresser(const Skeleton& skeleton, Branches& branches, const std::vector<Cut>& cuts,
                  const TemplateOptions& options)
      : branches_(branches),
        cuts_(cuts),
        options_(options),
        builder_(skeleton, branches, branches.nodes.size() + 3 * branches.branches.size(), options.stem),
        starts_(branches.branches.size()) {}

  ControlMesh dress() {
    for (std::uint32_t b = 0; b < branches_.branches.size(); ++b) {
      const Branch& branch = branches_.branches[b];
      if (branch.parent < 0) start_plant(b);
      const StemRing end = walk(b);
      if (branch.child_count > 0) {
        build_joint(b, end);
      } else {
        builder_.end_tip(end, branches_.axis(branch).back().position);
      }
    }
    return builder_.take();
  }

 private:
  // A joint whose normal is the frame's is vertex-forward.
  void start_plant(std::uint32_t b) {
    const AxisPoint at = point_on(branches_.axis(branches_.branches[b]), 0);
    starts_[b] = builder_.add_ring(at, frame_towards(at.tangent, cuts_[b].normal), nullptr, 0);
    builder_.end_base(starts_[b]);
  }

  // Adds a ring and the wall to it.
  StemRing go_on(const StemRing& from, const AxisPoint& at, double distance) {
    const StemRing ring = builder_.add_ring(at, transported(from.frame, at.tangent), &from, distance);
    builder_.add_wall(from, ring);
    return ring;
  }

  // From a branch's first ring to the one at its joint or tip; to the last but one where that is a point.
  StemRing walk(std::uint32_t b) {
    const Branch& branch = branches_.branches[b];
    const Cut& cut = cuts_[b];
    const auto axis = branches_.axis(branch);
    const double length = axis.back().along;
    double along = cut.base;
    StemRing ring = starts_[b];
    const auto reach = [&](const AxisPoint& at, double place) {
      ring = go_on(ring, at, place - along);
      along = place;
    };
    if (cut.collar > 0) reach(point_on(axis, cut.base + cut.collar), cut.base + cut.collar);

    const bool joint = branch.child_count > 0, point = !joint && options_.stem.tip == StemTip::kTapered;
    const double scale = options_.joint.gap * options_.stem.radius_scale;
    const double from = along + (branch.parent >= 0 ? scale * axis.front().radius : 0);
    const double to = length - cut.tip - (joint ? scale * axis.back().radius : 0);
    for (std::size_t i = 1; i + 1 < axis.size(); ++i) {
      const BranchNode& node = axis[i];
      if (!(node.along > from && node.along < to)) continue;
      reach({node.position, tangent_at(axis, i), node.radius, node.internode}, node.along);
    }
    if (!point) reach(point_on(axis, length - cut.tip), length - cut.tip);
    return ring;
  }

  // Gives every child its first ring.
  void build_joint(std::uint32_t b, const StemRing& end) {
    rings_.assign(1, end);
    for (const std::uint32_t child : branches_.children_of(branches_.branches[b])) {
      const Cut& cut = cuts_[child];
      AxisPoint at = point_on(branches_.axis(branches_.branches[child]), cut.base);
      if (cut.collar > 0) at.radius *= kCollarRadius;
      starts_[child] = builder_.add_ring(at, transported(end.frame, at.tangent), &end, cuts_[b].tip + cut.base);
      rings_.push_back(starts_[child]);
    }
    builder_.add_joint(rings_, cuts_[b].normal);
  }

  Branches& branches_;
  const std::vector<Cut>& cuts_;
  const TemplateOptions& options_;
  StemBuilder builder_;
  std::vector<StemRing> starts_;  // of every branch
  std::vector<StemRing> rings_;   // of the joint at hand
};

}  // namespace

ControlMesh template_mesh(const Skeleton& skeleton, const TemplateOptions& options) {
  Branches branches = branches_of(skeleton, BranchEnd::kAtJoints);
  const std::vector<Cut> cuts = plan_joints(branches, options.joint, options.stem.radius_scale);
  return TemplateDresser(skeleton, branches, cuts, options).dress();
}

}  // namespace barkridge
