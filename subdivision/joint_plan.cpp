#include "subdivision/joint_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "subdivision/joint.h"

namespace barkridge {

namespace {

// From a thin branch's collar to its first cross-section, in radii of the branch.
constexpr double kCollarLength = 1.0;
// What joints may take of a branch's length.
constexpr double kMostTaken = 0.8;

// How far along an axis its direction at a joint is measured, in radii of the joint's thickest branch: about as far as
// branches are cut back, so that curved ones are where they part.
constexpr double kReach = 2.0;

Vec3 direction_or(const Vec3& direction, const Vec3& otherwise) {
  return glm::length(direction) > 0 ? glm::normalize(direction) : glm::normalize(otherwise);
}

// The directions in which an axis leaves the joint at its base, and the one at its tip. An axis that returns to the
// joint has that of its internode there.
Vec3 from_base(std::span<const BranchNode> axis, double reach) {
  const Vec3 joint = axis.front().position;
  return direction_or(point_on(axis, std::min(reach, axis.back().along)).position - joint, axis[1].position - joint);
}
Vec3 from_tip(std::span<const BranchNode> axis, double reach) {
  const Vec3 joint = axis.back().position;
  return direction_or(point_on(axis, std::max(0.0, axis.back().along - reach)).position - joint,
                      axis[axis.size() - 2].position - joint);
}

void check_options(const JointOptions& options) {
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
  JointPlanner(Branches& branches, const JointOptions& options, double radius_scale, std::vector<Cut>& cuts)
      : branches_(branches), options_(options), scale_(radius_scale), cuts_(cuts) {}

  void plan(std::uint32_t carrier) {
    const Branch& branch = branches_.branches[carrier];
    const auto children = branches_.children_of(branch);
    const auto axis = branches_.axis(branch);
    double reach = axis.back().radius;
    for (const std::uint32_t child : children) {
      reach = std::max(reach, branches_.axis(branches_.branches[child]).front().radius);
    }
    reach *= kReach * scale_;
    met_.clear();
    met_.push_back({from_tip(axis, reach), axis.back().radius * scale_, axis.back().internode});
    for (const std::uint32_t child : children) {
      const auto child_axis = branches_.axis(branches_.branches[child]);
      met_.push_back({from_base(child_axis, reach), child_axis[0].radius * scale_, child_axis[0].internode});
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
  const JointOptions& options_;
  double scale_;
  std::vector<Cut>& cuts_;
  std::vector<JointBranch> met_;  // the carrier first
  std::vector<bool> thin_;
};

}  // namespace

std::vector<Cut> plan_joints(Branches& branches, const JointOptions& options, double radius_scale) {
  check_options(options);
  std::vector<Cut> cuts(branches.branches.size());
  JointPlanner planner(branches, options, radius_scale, cuts);
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

}  // namespace barkridge
