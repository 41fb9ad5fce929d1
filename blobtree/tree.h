#pragma once
// The BlobTree: primitives joined by operators, as an editable value.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/geometry.h"
#include "blobtree/field.h"

namespace barkridge {

// ---- Primitives. Lengths in scene units. Each has a falloff of its distance over twice its radius, so that the
// surface
// ---- of one alone lies at distance `radius` from its skeleton.

/// A round cone: the largest field of all spheres along the axis. Equal ends make a sphere of the larger radius, equal
/// radii a capsule. [docs/field.md, "Cone"; GMW04, section 3.2]
struct Cone {
  Vec3 base{0}, tip{0};
  double base_radius = 1, tip_radius = 1;  ///< > 0

  bool operator==(const Cone&) const = default;
};

/// A cone that runs on past its joined ends and fades there, so that parent and children hand over with weights that
/// sum to one. [docs/field.md, "Faded joints"]
struct FadedCone {
  Vec3 base{0}, tip{0};                    ///< differ
  double base_radius = 1, tip_radius = 1;  ///< > 0
  /// Tip radius of the parent; 0 for a root, whose base is a round cap.
  double parent_radius = 0;
  /// Largest base radius among the children; 0 without children, where the tip is a round cap.
  double child_radius = 0;

  bool operator==(const FadedCone&) const = default;
};

/// A flat disc, thick by `radius` on every side.
struct Disc {
  Vec3 center{0}, normal{0, 1, 0};
  double disc_radius = 1;
  double radius = 0.5;

  bool operator==(const Disc&) const = default;
};

/// A torus.
struct Ring {
  Vec3 center{0}, normal{0, 1, 0};
  double ring_radius = 1;
  double radius = 0.25;

  bool operator==(const Ring&) const = default;
};

/// A flat simple polygon, thick by `radius` on every side. At least three vertices, in one plane.
struct Polygon {
  std::vector<Vec3> vertices;
  double radius = 0.25;

  bool operator==(const Polygon&) const = default;
};

// ---- Operators. Their children stand in the node.

/// Shape of the deformation where branches touch. [docs/field.md, "Precise contact"; after Cani 1993]
struct ContactShape {
  double width = 0.5;       ///< w: extent of the swelling in field units, 0 < w <= 0.5
  double swelling = 0.125;  ///< M: its height, w / 6 <= M <= w / 3
  /// Lets M rise above w / 3, up to 0.5: wider ridges, steeper bounds.
  bool allow_large_swelling = false;

  bool operator==(const ContactShape&) const = default;
};
/// Throws `InputError` that names the value and its range.
void check(const ContactShape& shape);

struct Sum {
  bool operator==(const Sum&) const = default;
};
/// (sum of F_i^n)^(1/n), children's negative values counting as 0. [GMW04, eq. 2]
struct Ricci {
  double exponent = 2;  ///< >= 1

  bool operator==(const Ricci&) const = default;
};
struct Union {
  bool operator==(const Union&) const = default;
};
struct Intersection {
  bool operator==(const Intersection&) const = default;
};
/// The first child without all others: min(F_A, 2T - F_B), and F_A itself wherever F_B is 0. [docs/field.md,
/// "Difference"]
struct Difference {
  bool operator==(const Difference&) const = default;
};
/// The first child minus the sum of the others: scars and hollows. [GMW04, section 3.5]
struct Negative {
  bool operator==(const Negative&) const = default;
};
/// Precise contact of any number of children, independent of their order. [GMW04, eq. 3]
struct Contact {
  ContactShape shape;

  bool operator==(const Contact&) const = default;
};

inline constexpr int kMostNoiseOctaves = 8;
/// Noise in space, from -1 to 1. [docs/field.md, "Displacement"]
struct SolidNoise {
  double wavelength = 1;  ///< > 0: the distance between neighbouring features of the first octave, in the plane y = 0
  double stretch = 1;     ///< > 0: by how much they are longer along y
  int octaves = 3;        ///< 1 to kMostNoiseOctaves, each of half the wavelength and a quarter of the height
  bool ridged = false;    ///< narrow fissures between plateaus, instead of hills and valleys alike
  int seed = 0;

  bool operator==(const SolidNoise&) const = default;
};

/// Moves the surface of its one child, which may be any tree, in and out: F(p) (1 + amount n(p)) with solid noise n.
/// [docs/field.md, "Displacement"]
struct Displacement {
  double amount = 0.25;  ///< in [0, 1); from 1/2 on it may lay open a primitive's very axis
  SolidNoise noise;

  bool operator==(const Displacement&) const = default;
};

// ---- Warps: F(w(p)), one child.

/// Bends the child's axis, which starts at `base` towards `tip`, into a circular arc from `base` to `tip` that bulges
/// towards `direction`. The arc is longer than its chord: the child's point at `arc_length(bend)` along the axis comes
/// to lie at `tip`. Past both ends space follows straight. [docs/field.md, "Bend"; GMW04, section 3.6]
struct Bend {
  Vec3 base{0}, tip{0, 1, 0};  ///< differ
  Vec3 direction{1, 0, 0};     ///< not along the axis; only its part across the axis counts
  double angle_degrees = 30;   ///< in (0, 180)

  bool operator==(const Bend&) const = default;
};
double arc_length(const Bend& bend);
/// Turns space about an axis, by an angle that grows with the distance along it.
struct Twist {
  Vec3 origin{0}, axis{0, 1, 0};
  double degrees_per_unit = 90;

  bool operator==(const Twist&) const = default;
};
/// Scales across an axis by a factor that changes from 1 at `base` to `tip_scale` at `tip`, constant past both.
struct Taper {
  Vec3 base{0}, tip{0, 1, 0};
  double tip_scale = 0.5;  ///< > 0

  bool operator==(const Taper&) const = default;
};
/// Moves the child by q = linear * p + offset; `linear` is invertible.
struct Affine {
  Mat3 linear{1};
  Vec3 offset{0};

  bool operator==(const Affine&) const = default;
};

/// Index of a node in its tree.
using NodeId = std::uint32_t;
inline constexpr NodeId kNoNode = 0xffffffff;

struct Node {
  std::variant<Cone, FadedCone, Disc, Ring, Polygon,                            //
               Sum, Ricci, Union, Intersection, Difference, Negative, Contact,  //
               Displacement,                                                    //
               Bend, Twist, Taper, Affine>
      what;
  std::vector<NodeId> children;

  bool operator==(const Node&) const = default;
};

/// The tree: nodes in a row, every child before its parent, so that a plain loop visits children first and no depth is
/// too deep. A value: copy it, edit nodes in place, add more. Nodes that the root does not reach are allowed and
/// ignored; a node has one parent.
struct BlobTree {
  std::vector<Node> nodes;
  NodeId root = 0;  ///< meaningless while `nodes` is empty: the zero field

  /// Appends a node, makes it the root, and returns its id. The children must exist already.
  NodeId add(decltype(Node::what) what, std::vector<NodeId> children = {});

  bool operator==(const BlobTree&) const = default;
};

/// Throws `InputError` at the first node that breaks a rule stated above: a number out of range or not finite, a wrong
/// number of children, a child that does not come before its parent or has two.
void check(const BlobTree& tree);
/// The same for a node by itself: its numbers and how many children it has.
void check(const Node& node);

/// The number of nodes on the longest way from the root to a primitive; 0 for the empty tree.
std::size_t depth(const BlobTree& tree);

/// The smallest surface radius among the primitives that the root reaches, what a mesh must resolve: scaled as tapers
/// and affine nodes above it scale it at the most. 0 without primitives.
double thinnest_radius(const BlobTree& tree);

/// The shortest wavelength of an octave of all displacements that the root reaches, scaled likewise; infinite without
/// one.
double finest_wavelength(const BlobTree& tree);

/// The text form, readable by `parse_tree`, which gives back an equal tree up to the numbers of its nodes:
///     sum {
///       cone(base = 0 0 0, tip = 0 1 0, base_radius = 0.3, tip_radius = 0.2)
///       contact(width = 0.5, swelling = 0.125) { ... }
///     }
std::string to_string(const BlobTree& tree);

/// Reads the text form; arguments left out have their defaults, `#` starts a comment. The result is checked.
/// Throws `InputError` with place. `first_line` and `file` say where the text stands.
BlobTree parse_tree(std::string_view text, const std::string& file, int first_line = 1);

/// The model as a field for work: pruned by region, in double precision.
std::shared_ptr<const Field> compile(const BlobTree& tree);

/// The model as a field that is slow and obviously right: the oracle. `restricted` returns the field itself.
std::shared_ptr<const Field> reference_field(const BlobTree& tree);

}  // namespace barkridge
