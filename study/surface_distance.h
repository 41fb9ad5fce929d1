#pragma once
// How far one surface is from another: the error that the study sets against time.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/geometry.h"
#include "mesh/mesh.h"

namespace barkridge {

/// Finds the nearest point of a mesh. Immutable; may be asked from many threads at once.
class NearestPoint {
 public:
  /// Keeps what it needs of the mesh, which must have a triangle. Throws `std::bad_alloc`.
  explicit NearestPoint(const Mesh& mesh);
  ~NearestPoint();
  NearestPoint(NearestPoint&&) noexcept;

  /// The distance from `point` to the mesh, exact to about 1e-7 of the size of mesh and point together.
  double distance(const Vec3& point) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

/// Points spread over a mesh: every vertex, and every triangle's middles of edges and of itself. Triangles without an
/// area give points like all others.
std::vector<Vec3> points_of(const Mesh& mesh);

/// What a set of distances amounts to, in scene units.
struct DistanceSummary {
  double largest = 0;
  double mean_square = 0;
  std::size_t count = 0;

  double root_mean_square() const;
};

DistanceSummary summary(std::span<const double> distances);
/// Of both sets together.
DistanceSummary unite(const DistanceSummary& a, const DistanceSummary& b);

/// From the points to the mesh. Parallel; the same for any number of threads.
DistanceSummary distances(std::span<const Vec3> points, const NearestPoint& to);

/// The two-sided distance of two meshes, by the points of each: `largest` is Hausdorff's distance, as far as points
/// show it.
DistanceSummary two_sided_distance(const Mesh& a, const Mesh& b);

}  // namespace barkridge
