#pragma once
// A control mesh between two steps of Loop subdivision, ready for the next.

#include <cstdint>
#include <functional>
#include <vector>

#include "subdivision/control_mesh.h"
#include "subdivision/loop.h"
#include "subdivision/sheet.h"

namespace barkridge {

struct LoopLevel {
  Sheet<glm::vec3> surface;
  /// Its vertices are texture coordinates, one for each fan of a vertex's triangles between seams, its boundaries seams
  /// and boundaries of the surface, its triangles those of the surface in the same order; empty without texture.
  Sheet<glm::vec2> charts;
  std::vector<InternodeId> internodes;  ///< as of `ControlMesh`
  std::vector<float> ages;
};

/// Throws as `check` does.
LoopLevel coarse_level(const ControlMesh& mesh, const LoopOptions& options);

/// The next level; with triangles only it can be turned into a control mesh, but not refined or taken to its limit.
LoopLevel refined(const LoopLevel& level, Refine what);

/// The triangle counts of every level must stay within the limit: throws `LimitError` where `levels` steps would not.
void check_triangle_count(std::size_t coarse_triangles, int levels, const LoopOptions& options);

/// What may be done to a level after each step, counted from 1.
using AfterStep = std::function<void(LoopLevel& level, int step)>;

/// `levels` steps from a control mesh; the last makes `what`. Throws as `subdivide` does.
LoopLevel refined_level(const ControlMesh& mesh, int levels, Refine what, const LoopOptions& options,
                        const AfterStep& after_step = {});

ControlMesh to_control_mesh(LoopLevel level);

}  // namespace barkridge
