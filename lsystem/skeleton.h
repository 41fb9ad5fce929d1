#pragma once
// The waist between growing a plant and giving it a surface.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/geometry.h"

namespace barkridge {

/// Index of an internode in its skeleton; `kNoInternode` is the parent of a root.
using InternodeId = std::int32_t;
inline constexpr InternodeId kNoInternode = -1;

/// How the bark ridge of a fork is to be shaped: the extent and the height of the swelling beside it, in field units.
/// [docs/field.md, "Precise contact"]
struct Ridge {
  double width = 0.5;
  double swelling = 0.125;

  bool operator==(const Ridge&) const = default;
};
inline constexpr std::int32_t kNoRidge = -1;

/// A straight piece of a branch, a truncated cone: lengths in scene units, radii (not diameters).
struct Internode {
  Vec3 base{0};
  Vec3 tip{0};
  double base_radius = 0;  ///< > 0
  double tip_radius = 0;   ///< > 0
  InternodeId parent = kNoInternode;
  /// 0 for the trunk; one more than the parent's when it leaves the parent inside a bracket.
  std::int32_t order = 0;
  /// The derivation step in which its module appeared; 0 where the source does not say.
  std::int32_t birth_step = 0;
  /// Its index in the skeleton that this one was pruned from; -1 where it has its own. See `identity`.
  InternodeId source = -1;
  /// Index in the skeleton's ridges: the shape of the ridge between this internode and others that start at its base.
  std::int32_t ridge = kNoRidge;
};

/// Something other than an internode that the turtle drew: a leaf surface, a sphere, a disc.
struct Organ {
  std::string kind;  ///< the command without arguments: "~l", "@O", "@c", "@o"
  Vec3 position{0};
  /// Turtle frame, right-handed and orthonormal: heading, left, up = heading x left.
  Vec3 heading{0, 1, 0};
  Vec3 left{-1, 0, 0};
  Vec3 up{0, 0, 1};
  double size = 1;  ///< diameter of a sphere or disc, scale of a surface
  std::int32_t color = 0;
  InternodeId internode = kNoInternode;  ///< the internode at whose tip it grew
};

/// A branch that the plant has lost.
struct ShedBranch {
  InternodeId parent = kNoInternode;  ///< the internode at whose tip it grew
  Vec3 base{0};
  Vec3 heading{0, 1, 0};  ///< unit, of its first internode
  double radius = 0;      ///< > 0, at its base when it was shed
  double age = 0;         ///< derivation steps since it was shed
};

/// The end of a branch whose rest was sawn or broken off: a plane through the tip of an internode without children.
struct CutEnd {
  InternodeId internode = kNoInternode;
  Vec3 normal{0, 1, 0};  ///< towards what is missing; of length 1, at most kSteepestCutDegrees from the axis
  double splinters = 0;  ///< height of the splinters of a torn break over the plane, in tip radii; 0 for a clean cut
};
inline constexpr double kSteepestCutDegrees = 60;
inline constexpr double kLongestSplinters = 20;

/// What a shed branch leaves on the branch that carried it: a low stub with a hollow. Lengths in base radii of the shed
/// branch, heights along the bark's normal where its axis left the bark.
struct ScarShape {
  double width = 1;    ///< radius of the hollow, > 0
  double depth = 0.3;  ///< of the hollow's floor below the stub's top, >= 0
  double stub = 0.3;   ///< height of the stub's top over the bark, from 0 to 1
};
/// Throws `InputError` that names the value and its range.
void check(const ScarShape& shape);

struct Scar {
  InternodeId internode = kNoInternode;  ///< the shed branch's first internode: without children, with a parent
  ScarShape shape;
};

/// A branching structure. Parents come before children; both ends of every internode differ.
struct Skeleton {
  std::vector<Internode> internodes;
  std::vector<Organ> organs;
  std::vector<Ridge> ridges;
  std::vector<ShedBranch> shed_branches;
  /// In the order of their internodes; no internode has more than one of these.
  std::vector<CutEnd> cut_ends;
  std::vector<Scar> scars;
  /// Internodes of zero length that were dropped, their children attached to their parents.
  std::size_t dropped_internodes = 0;
};

/// The number by which rules know an internode, however much was pruned before.
inline InternodeId identity(const Skeleton& skeleton, std::size_t index) {
  const InternodeId source = skeleton.internodes[index].source;
  return source == kNoInternode ? static_cast<InternodeId>(index) : source;
}

/// The children of every internode, by index, in the skeleton's order, without a vector each: those of internode `i`
/// are `children[first[i]] .. children[first[i + 1] - 1]`. Roots are the children of index `internodes.size()`.
struct ChildTable {
  std::vector<std::uint32_t> first;
  std::vector<InternodeId> children;
};
ChildTable child_table(const Skeleton& skeleton);

/// Drops internodes whose ends coincide, attaches their children to their parents, and counts them. Organs and what
/// was shed follow; cut ends and scars of what is dropped go with it.
Skeleton without_zero_lengths(Skeleton skeleton);

/// The skeleton table: a first line `# barkridge skeleton 1`, then a line an internode,
/// `id parent x0 y0 z0 x1 y1 z1 r0 r1`, parents before children, parent -1 at a root, 9 significant digits.
/// Where ridges, cut ends or scars are to be written the first line is `# barkridge skeleton 2`, and lines
/// `ridge id width swelling`, `cut id nx ny nz splinters` and `scar id width depth stub` follow. Organs, shed branches
/// and births are not written. Reading accepts ids in any order as long as parents precede children,
/// blank lines and further `#` comments; it throws `InputError` for a wrong header, a wrong number of fields, numbers
/// that are not finite, radii not above zero, repeated ids and unknown parents. Orders are derived: the thickest child
/// continues its parent's order.
std::string write_skeleton_table(const Skeleton& skeleton);
Skeleton read_skeleton_table(std::string_view text, const std::string& file);

}  // namespace barkridge
