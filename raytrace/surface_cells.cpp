#include "raytrace/surface_cells.h"

#include <tbb/parallel_for.h>

#include <array>

namespace barkridge {

namespace {

enum class Verdict { kEmpty, kLeaf, kSplit };

int longest_axis(const Box& box) {
  const Vec3 size = box.hi - box.lo;
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

// Cuts slabs that are empty off the six sides.
Box trimmed(const Field& field, Box box) {
  constexpr double kSlab = 0.25;
  for (int axis = 0; axis < 3; ++axis) {
    const double thickness = kSlab * (box.hi[axis] - box.lo[axis]);
    Box below = box, above = box;
    below.hi[axis] = box.lo[axis] + thickness;
    above.lo[axis] = box.hi[axis] - thickness;
    if (field.bounds(below).value.hi < kIsoValue) box.lo[axis] = below.hi[axis];
    if (field.bounds(above).value.hi < kIsoValue) box.hi[axis] = above.lo[axis];
  }
  return box;
}

// Decides about a box and shrinks it to the part that matters.
Verdict judge(SurfaceCell& cell, double min_size, const SurfaceCellOptions& options) {
  cell.box = intersect(cell.box, cell.field->support());
  if (cell.box.empty()) return Verdict::kEmpty;
  const FieldBounds bounds = cell.field->bounds(cell.box);
  if (bounds.value.hi < kIsoValue) return Verdict::kEmpty;
  cell.solid = bounds.value.lo >= kIsoValue;
  if (cell.solid) return Verdict::kLeaf;
  const double diagonal = cell.box.diagonal();
  return bounds.slope * diagonal > options.max_variation && diagonal > min_size ? Verdict::kSplit : Verdict::kLeaf;
}

std::array<SurfaceCell, 2> halves(const SurfaceCell& cell) {
  const int axis = longest_axis(cell.box);
  std::array<SurfaceCell, 2> parts{cell, cell};
  parts[0].box.hi[axis] = parts[1].box.lo[axis] = cell.box.center()[axis];
  for (SurfaceCell& part : parts) part.field = cell.field->restricted(part.box);
  return parts;
}

}  // namespace

std::vector<SurfaceCell> surface_cells(const Field& field, const SurfaceCellOptions& options) {
  std::vector<SurfaceCell> leaves;
  const Box whole = field.support();
  if (whole.empty()) return leaves;
  const double min_size = options.min_relative_size * whole.diagonal();

  // Round by round, so that threads share the work and order does not depend on them.
  std::vector<SurfaceCell> round{{whole, field.restricted(whole)}};
  std::vector<Verdict> verdicts;
  std::vector<std::array<SurfaceCell, 2>> split;
  while (!round.empty()) {
    report(options.progress, 0);
    const bool may_split = leaves.size() + 2 * round.size() <= options.max_cells;
    verdicts.assign(round.size(), Verdict::kEmpty);
    split.assign(round.size(), {});
    tbb::parallel_for(std::size_t{0}, round.size(), [&](std::size_t i) {
      verdicts[i] = judge(round[i], min_size, options);
      if (verdicts[i] == Verdict::kSplit && may_split) {
        split[i] = halves(round[i]);
      } else if (verdicts[i] != Verdict::kEmpty) {
        verdicts[i] = Verdict::kLeaf;
        if (!round[i].solid) round[i].box = trimmed(*round[i].field, round[i].box);
      }
    });
    std::vector<SurfaceCell> next;
    for (std::size_t i = 0; i < round.size(); ++i) {
      if (verdicts[i] == Verdict::kLeaf) leaves.push_back(std::move(round[i]));
      if (verdicts[i] == Verdict::kSplit) {
        for (SurfaceCell& part : split[i]) next.push_back(std::move(part));
      }
    }
    round = std::move(next);
  }
  return leaves;
}

}  // namespace barkridge
