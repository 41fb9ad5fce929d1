#pragma once
// Leaves: open sheets along the axes of a skeleton, simple or compound.

#include "subdivision/control_mesh.h"
#include "subdivision/joint_plan.h"

namespace barkridge {

/// How leaves get texture coordinates.
enum class LeafTexture {
  /// One picture for the leaf, from which it is cut as if it lay flat: axes turn in their plane as in space, and
  /// neither
  /// bend out of it nor twist. (0, 0) is the lower left of the box around it, the longer side of which is 1; the axis
  /// points to +v at the base. No seams.
  kWhole,
  /// One picture for each lobe: u runs from 0 at a branch's left margin over 1/2 at its midrib to 1, v by 1 from the
  /// joint where the branch leaves to the branch's end, and on. Seams between neighbouring lobes.
  kLobes,
};

struct LeafOptions {
  /// Angle by which both halves of the blade are raised against each other, 0 to less than 90.
  double fold_degrees = 15;
  /// Steps of subdivision for which the midrib stays a crease; 0 for none, infinite for all.
  float midrib_sharpness = kInfinitelySharp;
  /// Length of the two triangles at a tip, in half widths of the blade there; 0 leaves tips square.
  double point_length = 1.5;
  /// Whether the point keeps its place in subdivision, or is rounded.
  bool sharp_point = true;
  /// Where a leaf without joints turns its upper side, as nearly as its axis allows; a leaf with joints lies in the
  /// plane of the first, and of the plane's sides takes the nearer one.
  Vec3 up{0, 0, 1};
  LeafTexture texture = LeafTexture::kWhole;
  /// `thin_ratio` is of no meaning here.
  JointOptions joint;
};

/// Dresses a skeleton as a leaf [Mac04, section 5.4]: at the ends of internodes cross-sections of margin, midrib and
/// margin, the skeleton's radius being half the width of the blade; branches of any number at a joint that lie in a
/// plane, cut back by equations 5.1 and 5.2, and joined by triangles around the end of the carrying midrib. The margins
/// of neighbouring branches start at a common vertex. Cross-sections before a joint lie in its plane. Triangles are
/// counter-clockwise seen from the upper side; every root is a piece of its own, a disc.
///
/// Throws `InputError` for options out of range and what `branches_of` and `plan_joints` refuse, and `LimitError` for
/// more vertices than can be numbered. Cost: as `template_mesh`.
ControlMesh leaf_mesh(const Skeleton& skeleton, const LeafOptions& options = {});

}  // namespace barkridge
