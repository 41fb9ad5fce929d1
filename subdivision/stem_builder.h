#pragma once
// Stems as rings of vertices and walls between them.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "subdivision/branches.h"
#include "subdivision/control_mesh.h"
#include "subdivision/frames.h"
#include "subdivision/joint_template.h"
#include "subdivision/stem_options.h"

namespace barkridge {

/// Corners of a cross-section.
inline constexpr std::uint32_t kRingSize = 6;

/// A hexagon of vertices of the mesh, counter-clockwise around the tangent from the normal's direction.
struct StemRing {
  Vec3 center{0};
  Frame frame;
  double radius = 0;
  double v = 0;  ///< texture coordinate along the stem
  InternodeId internode = 0;
  std::uint32_t first_vertex = 0;
  std::uint32_t first_texture = 0;
};

/// Makes a control mesh ring by ring, with texture, internodes and ages.
class StemBuilder {
 public:
  /// Throws `InputError` for options out of range, and `LimitError` where `max_rings` would give more vertices than
  /// triangles can number.
  StemBuilder(const Skeleton& skeleton, const Branches& branches, std::size_t max_rings, const StemOptions& options);

  /// A ring around a point of an axis. `before` is the ring from which texture coordinates go on over the given
  /// distance, or null at the base of a plant.
  StemRing add_ring(const AxisPoint& at, const Frame& frame, const StemRing* before, double distance);
  /// The wall between two rings, the second nearer to the tip.
  void add_wall(const StemRing& lower, const StemRing& upper);
  /// Closes a stem below its lowest ring, or leaves it open, by the options.
  void end_base(const StemRing& ring);
  /// Ends a stem above its last ring by the options; a tapered one at `tip`.
  void end_tip(const StemRing& ring, const Vec3& tip);
  /// The triangles of a joint. `rings` are counter-clockwise around the normal; the first is the carrying branch's,
  /// whose tangent points into the joint, all others' point out of it.
  void add_joint(std::span<const StemRing> rings, const Vec3& normal);

  /// The mesh. The builder is empty then.
  ControlMesh take();

 private:
  std::uint32_t add_vertex(const Vec3& position, InternodeId internode);
  void add_fan(const StemRing& ring, const Vec3& apex, bool at_tip);
  void crease_rim(const StemRing& ring);
  std::uint32_t texture_at(const StemRing& ring, std::uint32_t corner) const;
  double v_after(const StemRing& before, double radius, double distance) const;
  void unroll_joint(std::span<const StemRing> rings, std::size_t first_triangle);
  // Texture coordinates of a joint's vertices as seen from a ring, by the ring's first vertex, vertex, and winding.
  using JointTexture = std::map<std::tuple<std::uint32_t, std::uint32_t, int>, std::uint32_t>;
  void unroll_triangle(const StemRing& owner, const std::array<std::uint32_t, 3>& triangle, JointTexture& known);

  const Skeleton& skeleton_;
  StemOptions options_;
  double longest_path_;
  ControlMesh mesh_;
};

}  // namespace barkridge
