#pragma once
// Warps: the field at p is the child's at w(p). [docs/field.md, "Warps" and "Bend"]

#include <limits>
#include <variant>

#include "blobtree/tree.h"

namespace barkridge {

/// Where a point comes from, and the Jacobian dw/dp there (columns are derivatives by x, y, z).
struct WarpedPoint {
  Vec3 point{0};
  Mat3 jacobian{1};
};

/// A box that holds w(p) for every p of a box, and a bound of the Jacobian's norm there.
struct WarpedBox {
  Box box;
  double stretch = 1;
  /// A bound of the length of w's second derivative along lines there, but for jumps of the first; infinite where it is
  /// not known.
  double curvature = std::numeric_limits<double>::infinity();
  /// A bound of all jumps of w's first derivative along lines.
  double jump = 0;
};

/// Where the ends of a piece of a line come from, and what WarpedBox says, on the piece.
struct WarpedPiece {
  Vec3 from{0}, to{0};
  double stretch = 1;
  double curvature = std::numeric_limits<double>::infinity();
  double jump = 0;
};

/// A warp prepared for evaluation. `reach` is how far the child's field extends from the warp's axis: only bends use
/// it, whose stretch is bounded where the child is.
class Warp {
 public:
  /// All but affine warps act in a frame: x along the axis from `origin`, y and z across it.
  struct Framed {
    Vec3 origin;
    Mat3 axes;  // columns
    Vec3 to_local(const Vec3& p) const { return glm::transpose(axes) * (p - origin); }
    Vec3 to_world(const Vec3& q) const { return axes * q + origin; }
    Box to_local(const Box& box) const;
    Box to_world(const Box& box) const;
  };
  struct BendData {
    Framed frame;  // origin at the base, x along the chord, y towards the bulge
    double half_angle, arc_radius, arc, chord, reach;
    double sine, cosine;   // of the half angle
    double center_height;  // of the arc's centre, in the frame

    /// Where the middle of the arc comes from: what mapped points are best counted from.
    Vec3 straight_middle() const { return frame.to_world({0.5 * arc, 0, 0}); }
  };

  Warp(const Bend& bend, const Box& child_support);
  explicit Warp(const Twist& twist);
  explicit Warp(const Taper& taper);
  explicit Warp(const Affine& affine);

  Vec3 map(const Vec3& p) const { return map_with_jacobian(p).point; }
  WarpedPoint map_with_jacobian(const Vec3& p) const;
  WarpedBox map(const Box& box) const;
  /// Of the piece of a line between two points. Under a bend its stretch, curvature and jump count only where the child
  /// reaches.
  WarpedPiece map(const Vec3& from, const Vec3& to) const;
  /// The bend, if it is one: bends have kernels of their own [blobtree/bend_kernels.h].
  const BendData* bend() const { return std::get_if<BendData>(&data_); }
  /// A box that holds every p with w(p) in `child_support`.
  Box support(const Box& child_support) const;
  /// The same for a bend, from a box in its frame to one in it: along the axis, which boxes in the world wrap but
  /// loosely.
  Box bent_support(const Box& local) const;
  /// Where a bend moves the point of its axis at a height over the base, in the world.
  Vec3 bent_axis(double height) const;

 private:
  struct TwistData {
    Framed frame;
    double radians_per_unit;
  };
  struct TaperData {
    Framed frame;
    double length, tip_scale;
  };
  struct AffineData {
    Mat3 inverse;
    Vec3 offset;
    Mat3 linear;
    double stretch;
  };

  static WarpedPoint map_local(const BendData& data, const Vec3& q);
  static WarpedPoint map_local(const TwistData& data, const Vec3& q);
  static WarpedPoint map_local(const TaperData& data, const Vec3& q);
  static WarpedBox map_local(const BendData& data, const Box& box);
  static WarpedPiece map_local(const BendData& data, const Vec3& from, const Vec3& to);
  static WarpedBox map_local(const TwistData& data, const Box& box);
  static WarpedBox map_local(const TaperData& data, const Box& box);
  static Box support_local(const BendData& data, const Box& box);
  static Box support_local(const TwistData& data, const Box& box);
  static Box support_local(const TaperData& data, const Box& box);

  std::variant<BendData, TwistData, TaperData, AffineData> data_;
};

}  // namespace barkridge
