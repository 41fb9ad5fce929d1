#include "polygonize/polygonize.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <mutex>
#include <vector>

#include "polygonize/crease_closing.h"
#include "polygonize/lattice.h"
#include "polygonize/stitch.h"
#include "polygonize/surface_block.h"
#include "polygonize/unresolved_pieces.h"

namespace barkridge {

namespace {

// Share of the progress that finding the surface takes; stitching is the rest.
constexpr double kSearchShare = 0.98;

// Halves the longer axes, so that parts become cubes, then small cubes.
std::vector<BlockRange> split(const BlockRange& range) {
  const glm::ivec3 size = range.hi - range.lo;
  const int longest = std::max({size.x, size.y, size.z});
  std::vector<BlockRange> parts{range};
  for (int axis = 0; axis < 3; ++axis) {
    if (2 * size[axis] <= longest || size[axis] == 1) continue;
    const int middle = range.lo[axis] + size[axis] / 2;
    for (std::size_t i = parts.size(); i-- > 0;) {
      parts.push_back(parts[i]);
      parts[i].hi[axis] = middle;
      parts.back().lo[axis] = middle;
    }
  }
  return parts;
}

// The search for the blocks that have surface, from all blocks at once down to single ones, in parallel. On its way
// down each part of space has its own restriction of the field, made from that of the part around it.
class SurfaceSearch {
 public:
  SurfaceSearch(const Lattice& lattice, const PolygonizeOptions& options) : lattice_(lattice), options_(options) {}

  // `field` is restricted to the range's box with its halo. `share` is the share of all work that the range stands for.
  void visit(const BlockRange& range, const Field& field, double share) {
    if (range.is_single()) {
      visit_block(range, field);
      add_progress(share);
      return;
    }
    std::vector<BlockRange> parts = split(range);
    std::erase_if(parts, [&](const BlockRange& part) { return !may_have_surface(field, part); });
    if (parts.empty()) {
      add_progress(share);
      return;
    }
    tbb::parallel_for(
        std::size_t{0}, parts.size(),
        [&](std::size_t i) {
          const auto restricted = field.restricted(box_with_halo(parts[i]));
          visit(parts[i], *restricted, share / static_cast<double>(parts.size()));
        },
        tbb::simple_partitioner{});
  }

  std::vector<SurfaceBlock> take_blocks() {
    std::vector<SurfaceBlock> all;
    for (Local& local : locals_) {
      all.insert(all.end(), std::move_iterator(local.blocks.begin()), std::move_iterator(local.blocks.end()));
      local.blocks = {};
    }
    return all;
  }

 private:
  struct Local {
    BlockScratch scratch;
    std::vector<SurfaceBlock> blocks;
  };

  bool may_have_surface(const Field& field, const BlockRange& range) const {
    const Interval value = field.bounds(box_of(lattice_, range)).value;
    return !(value.hi < kIsoValue) && !(value.lo >= kIsoValue);
  }

  Box box_with_halo(const BlockRange& range) const {
    // A little more than the halo, so that rounding leaves no lattice point outside.
    return grown(box_of(lattice_, range), (kCreaseHalo + 0.01) * lattice_.cell_size);
  }

  void visit_block(const BlockRange& single, const Field& with_halo) {
    Local& local = locals_.local();
    const auto restricted = with_halo.restricted(box_of(lattice_, single));
    std::optional<SurfaceBlock> block =
        sample_block(lattice_, *restricted, options_.close_creases ? &with_halo : nullptr, single.lo, local.scratch);
    if (!block) return;
    check_limits(triangle_count_ += block->triangle_count, vertex_count_ += block->numbers.count());
    place_vertices(lattice_, *restricted, *block, local.scratch);
    local.blocks.push_back(std::move(*block));
  }

  void check_limits(std::size_t triangles, std::size_t vertices) const {
    if (options_.max_triangles != 0 && triangles > options_.max_triangles) {
      throw LimitError(
          fmt::format("the mesh has more triangles than the limit of {}; use cells larger than {} or "
                      "raise the limit",
                      options_.max_triangles, options_.cell_size));
    }
    if (vertices > std::size_t{std::numeric_limits<std::int32_t>::max()}) {
      throw LimitError(fmt::format("the mesh has more than {} vertices; use cells larger than {}",
                                   std::numeric_limits<std::int32_t>::max(), options_.cell_size));
    }
  }

  void add_progress(double share) {
    done_ += share;
    // A thread that finds another one reporting has its share reported by a later one.
    const std::unique_lock lock(reporting_, std::try_to_lock);
    if (lock) report(options_.progress, std::min(1.0, done_.load()) * kSearchShare);
  }

  const Lattice lattice_;
  const PolygonizeOptions& options_;
  tbb::enumerable_thread_specific<Local> locals_;
  std::atomic<std::size_t> triangle_count_ = 0;
  std::atomic<std::size_t> vertex_count_ = 0;
  std::atomic<double> done_ = 0;
  std::mutex reporting_;
};

}  // namespace

Mesh polygonize(const Field& field, const PolygonizeOptions& options) {
  const Box support = field.support();
  const Lattice lattice = make_lattice(support.empty() ? Box{Vec3(0), Vec3(0)} : support, options.cell_size);
  report(options.progress, 0);
  Mesh mesh;
  if (!support.empty()) {
    SurfaceSearch search(lattice, options);
    search.visit(blocks_around(lattice, support), field, 1);
    mesh = stitch(search.take_blocks());
    if (options.close_creases) remove_unresolved_pieces(mesh, options.cell_size);
  }
  report(options.progress, 1);
  return mesh;
}

}  // namespace barkridge
