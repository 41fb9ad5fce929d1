#include "subdivision/loop.h"

#include "subdivision/loop_level.h"

namespace barkridge {

ControlMesh subdivide(const ControlMesh& mesh, int levels, const LoopOptions& options) {
  return to_control_mesh(refined_level(mesh, levels, Refine::triangles, options));
}

}  // namespace barkridge
