#pragma once

#include "base/geometry.h"
#include "subdivision/control_mesh.h"

namespace barkridge {

/// The part of a control mesh that decides about its limit surface inside of `box`: refined, it is the same there as
/// the whole, and outside of it may differ. Texture, internodes and ages are left out. O(n).
ControlMesh patch_for(const ControlMesh& mesh, const Box& box);

}  // namespace barkridge
