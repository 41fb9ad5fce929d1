#include "subdivision/cylinder_mesh.h"

#include "subdivision/branches.h"
#include "subdivision/frames.h"
#include "subdivision/stem_builder.h"

namespace barkridge {

ControlMesh cylinder_mesh(const Skeleton& skeleton, const StemOptions& options) {
  const Branches branches = branches_of(skeleton, BranchEnd::kAtTips);
  StemBuilder builder(skeleton, branches, branches.nodes.size(), options);
  const bool points = options.tip == StemTip::kTapered;
  for (const Branch& branch : branches.branches) {
    const auto axis = branches.axis(branch);
    StemRing ring;
    for (std::size_t i = 0; i + (points ? 1 : 0) < axis.size(); ++i) {
      const AxisPoint at{axis[i].position, tangent_at(axis, i), axis[i].radius, axis[i].internode};
      if (i == 0) {
        ring = builder.add_ring(at, frame_towards(at.tangent, Vec3(0)), nullptr, 0);
        builder.end_base(ring);
        continue;
      }
      const StemRing next =
          builder.add_ring(at, transported(ring.frame, at.tangent), &ring, axis[i].along - axis[i - 1].along);
      builder.add_wall(ring, next);
      ring = next;
    }
    builder.end_tip(ring, axis.back().position);
  }
  return builder.take();
}

}  // namespace barkridge
