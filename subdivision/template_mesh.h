#pragma once
// The control mesh of a plant whose joints are planar.

#include "subdivision/control_mesh.h"
#include "subdivision/stem_options.h"

namespace barkridge {

struct TemplateOptions {
  StemOptions stem;
  /// A branch at most this many times as thick as a neighbour around its joint gets an asymmetric template: a collar of
  /// vertices around its base, which keeps the blend small and the neighbour round. At least 0: none.
  double thin_ratio = 1.0 / 3;
  /// Room between joint and cross-section on top of equations 5.1 and 5.2, in radii of the branch; > 0.
  double gap = 0.25;
  /// How far the branches at a joint may leave their common plane, 0 to 90. Within it they are sorted by their
  /// projections into the plane and keep their directions; 90 accepts every joint.
  double max_out_of_plane_degrees = 30;
};

/// Dresses a skeleton by junction templates [MacM04, chapter 5]: hexagonal cross-sections on parallel-transport frames
/// at the ends of internodes, branches cut back at joints by equations 5.1 and 5.2, and templates between them
/// (`triangulate_joint`). The first cross-section of a plant is turned so that its first joint is vertex-forward.
///
/// Every root, and every internode behind a gap (`branches_of`), is a piece of its own; pieces may overlap. A piece is
/// a sphere, or a disc when its base is open. Where branches are too short for what their joints need at both ends, all
/// of it is shortened in proportion, so that a fifth of the branch is left: the surface may meet itself there, and
/// remains manifold. Nodes closer to a cut than the gap are passed over.
///
/// Throws `InputError` for options out of range, for what `branches_of` and `branching_plane` refuse, and `LimitError`
/// for more vertices than can be numbered. Cost: linear in internodes (half a microsecond each), quadratic in the
/// branches of one joint.
ControlMesh template_mesh(const Skeleton& skeleton, const TemplateOptions& options = {});

}  // namespace barkridge
