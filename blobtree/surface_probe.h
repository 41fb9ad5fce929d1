#pragma once
// What the surface is made of at a point: which primitives, how much of each, and what contacts and cuts did to it.

#include <memory>
#include <vector>

#include "blobtree/tree.h"

namespace barkridge {

/// A primitive's share in the surface at a point.
struct SurfaceShare {
  NodeId primitive = 0;
  double weight = 1;  ///< above 0
  Vec3 point{0};      ///< the point where the warps above the primitive bring it: in the primitive's own space
  Mat3 jacobian{1};   ///< of `point` by the point in the world; columns are derivatives by x, y, z
};

/// Everything about a point of the surface that is not its shape. [docs/field.md, "Shares"]
struct SurfaceSample {
  /// Their weights add up to 1. Where something is cut away this is what it was cut from. Empty where F <= 0.
  std::vector<SurfaceShare> shares;
  /// What contacts added to the field, in field units: above 0 where they swell it, below 0 where they compress it.
  double deformation = 0;
  /// How much the point belongs to the ridge of a contact: 1 from the crease to the crest of the swelling, from there
  /// down with the swelling to 0.
  double ridge = 0;
  /// How much the surface is one that was laid open: 1 where a difference's cut made it; where a negative field of
  /// strength N takes away from it, N / T up to 1.
  double cut = 0;
  /// The primitive that cut most; meaningless where `cut` is 0.
  NodeId cutter = 0;
};

/// The largest of the shares, the first of equal ones; null where there is none.
const SurfaceShare* largest_share(const SurfaceSample& sample);

/// Answers for all points of a tree's surface, from those primitives alone whose supports hold the point. Immutable;
/// may be asked from many threads at once.
class SurfaceProbe {
 public:
  /// Throws `InputError` for trees that break a rule. Keeps no reference to the tree. Cost: as `compile`.
  explicit SurfaceProbe(const BlobTree& tree);
  ~SurfaceProbe();
  SurfaceProbe(SurfaceProbe&&) noexcept;

  /// Fills in `sample`, whose memory it uses again. About a microsecond where few supports overlap.
  void at(const Vec3& point, SurfaceSample& sample) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace barkridge
