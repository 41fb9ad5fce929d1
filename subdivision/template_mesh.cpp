#include "subdivision/template_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "subdivision/branches.h"
#include "subdivision/frames.h"
#include "subdivision/joint.h"
#include "subdivision/stem_builder.h"

namespace barkridge {

namespace {

// A collar's radius in radii of its branch, and how far before the branch's first cross-section it stands.
constexpr double kCollarRadius = 1.5;
constexpr double kCollarLength = 1.0;
// What joints may take of a branch's length.
constexpr double kMostTaken = 0.8;

// What is cut off a branch, lengths along its axis.
struct Cut {
  double base = 0;    // to the joint's ring
  double collar = 0;  // from there to the branch's own first ring; 0: the same
  double tip = 0;
  Vec3 normal{0};  // of the joint at its tip, if there is one
};

void check_options(const TemplateOptions& options) {
  const auto check = [](bool good, const char* name, double value, const char* expected) {
    if (!good) throw InputError(fmt::format("{} is {}: expected {}", name, value, expected));
  };
  check(options.thin_ratio >= 0 && options.thin_ratio < 1, "thin_ratio", options.thin_ratio, "0 to less than 1");
  check(options.gap > 0 && std::isfinite(options.gap), "gap", options.gap, "a finite number above 0");
  check(options.max_out_of_plane_degrees >= 0 && options.max_out_of_plane_degrees <= 90, "max_out_of_plane_degrees",
        options.max_out_of_plane_degrees, "0 to 90");
}

// Plans the joint at a branch's tip, and sorts the children around it.
class JointPlanner {
 public:
  JointPlanner(Branches& branches, const TemplateOptions& options, std::vector<Cut>& cuts)
      : branches_(branches), options_(options), cuts_(cuts) {}

  void plan(std::uint32_t carrier) {
    const Branch& branch = branches_.branches[carrier];
    const auto children = branches_.children_of(branch);
    const auto axis = branches_.axis(branch);
    const double scale = options_.stem.radius_scale;
    const BranchNode& end = axis.back();
    met_.clear();
    met_.push_back({glm::normalize(axis[axis.size() - 2].position - end.position), end.radius * scale, end.internode});
    for (const std::uint32_t child : children) {
      const auto child_axis = branches_.axis(branches_.branches[child]);
      met_.push_back({glm::normalize(child_axis[1].position - child_axis[0].position), child_axis[0].radius * scale,
                      child_axis[0].internode});
    }
    const Vec3 normal = branching_plane(met_, options_.max_out_of_plane_degrees);
    sort(children, around(met_, normal));
    add_collars(children);
    const std::vector<double> offsets = clearances(met_);
    cuts_[carrier].normal = normal;
    cuts_[carrier].tip = offsets[0] + options_.gap * met_[0].radius;
    for (std::size_t i = 0; i < children.size(); ++i) {
      cuts_[children[i]].base = offsets[i + 1] + options_.gap * met_[i + 1].radius;
    }
  }

 private:
  void sort(std::span<std::uint32_t> children, const std::vector<std::uint32_t>& order) {
    const std::vector<JointBranch> met = met_;
    const std::vector<std::uint32_t> unsorted(children.begin(), children.end());
    for (std::size_t i = 1; i < order.size(); ++i) {
      met_[i] = met[order[i]];
      children[i - 1] = unsorted[order[i] - 1];
    }
  }

  // Thin branches meet the joint with their collar's radius.
  void add_collars(std::span<const std::uint32_t> children) {
    const std::size_t count = met_.size();
    thin_.assign(count, false);
    for (std::size_t i = 1; i < count; ++i) {
      const double neighbour = std::max(met_[i - 1].radius, met_[(i + 1) % count].radius);
      thin_[i] = met_[i].radius <= options_.thin_ratio * neighbour;
    }
    for (std::size_t i = 1; i < count; ++i) {
      if (!thin_[i]) continue;
      cuts_[children[i - 1]].collar = kCollarLength * met_[i].radius;
      met_[i].radius *= kCollarRadius;
    }
  }

  Branches& branches_;
  const TemplateOptions& options_;
  std::vector<Cut>& cuts_;
  std::vector<JointBranch> met_;  // the carrier first
  std::vector<bool> thin_;
};

std::vector<Cut> plan_joints(Branches& branches, const TemplateOptions& options) {
  std::vector<Cut> cuts(branches.branches.size());
  JointPlanner planner(branches, options, cuts);
  for (std::uint32_t b = 0; b < cuts.size(); ++b) {
    if (branches.branches[b].child_count > 0) planner.plan(b);
  }
  for (std::size_t b = 0; b < cuts.size(); ++b) {
    Cut& cut = cuts[b];
    const double taken = cut.base + cut.collar + cut.tip;
    const double shrink = std::min(1.0, kMostTaken * branches.axis(branches.branches[b]).back().along / taken);
    if (!(shrink < 1)) continue;
    cut.base *= shrink;
    cut.collar *= shrink;
    cut.tip *= shrink;
  }
  return cuts;
}

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

    const bool joint = branch.child_count > 0, point = !joint && options_.stem.tip == TipKind::kTapered;
    const double scale = options_.gap * options_.stem.radius_scale;
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
  check_options(options);
  Branches branches = branches_of(skeleton, BranchEnd::kAtJoints);
  const std::vector<Cut> cuts = plan_joints(branches, options);
  return TemplateDresser(skeleton, branches, cuts, options).dress();
}

}  // namespace barkridge
