#pragma once

namespace barkridge {

/// How a branch ends where nothing grows on.
enum class StemTip {
  kCapped,   ///< by a flat cap at its tip, which refinement rounds
  kSharp,    ///< by a flat cap whose rim is a crease: a branch that was cut
  kTapered,  ///< by a point: the last internode narrows to its tip, which stays where it is
};

/// How stems get texture coordinates: u runs around a branch, v along it.
enum class StemTexture {
  /// Without seams: u is 0 and 1 in turn at the corners of a cross-section, so that six reflected copies of a picture
  /// go around, and v runs from 0 at the base of a plant to 1 at the end of the longest path [Mac04, section 6.4.2].
  kReflected,
  /// As if unrolled: u runs once around, with a seam, and v grows by 1 over a length that equals the circumference,
  /// which keeps squares square. At joints every triangle goes on with the coordinates of the branch that it shares its
  /// longest side with, and seams lie where these change [Pie12, section 4.3].
  kCylindrical,
};

/// What control meshes of stems have in common.
struct StemOptions {
  StemTip tip = StemTip::kCapped;
  /// Whether the base of a plant is closed, by a flat cap whose rim is a crease; otherwise it is a boundary.
  bool closed_base = true;
  StemTexture texture = StemTexture::kReflected;
  /// Radius of the cross-sections' corners in radii of the skeleton, > 0. The limit surface of a long straight branch
  /// is 5/6 as thick as its control mesh, so that 1.2 gives branches the thickness that the skeleton states.
  double radius_scale = 1;
};

}  // namespace barkridge
