#pragma once
// The control mesh of a plant whose joints are planar.

#include "subdivision/control_mesh.h"
#include "subdivision/joint_plan.h"
#include "subdivision/stem_options.h"

namespace barkridge {

struct TemplateOptions {
  StemOptions stem;
  JointOptions joint;
};

/// Dresses a skeleton by junction templates [Mac04, chapter 5]: hexagonal cross-sections on parallel-transport frames
/// at the ends of internodes, branches cut back at joints by equations 5.1 and 5.2, and templates between them
/// (`triangulate_joint`). The first cross-section of a plant is turned so that its first joint is vertex-forward.
///
/// Every root, and every internode behind a gap (`branches_of`), is a piece of its own; pieces may overlap. A piece is
/// a sphere, or a disc when its base is open. Where branches are too short for what their joints need at both ends, all
/// of it is shortened in proportion, so that a fifth of the branch is left: the surface may meet itself there, and
/// remains manifold. Nodes closer to a cut than the gap are passed over.
///
/// Throws `InputError` for options out of range, for what `branches_of` and `plan_joints` refuse, and `LimitError`
/// for more vertices than can be numbered. Cost: linear in internodes, quadratic in the branches of one joint; some
/// five microseconds for an internode where most end in joints.
ControlMesh template_mesh(const Skeleton& skeleton, const TemplateOptions& options = {});

}  // namespace barkridge
