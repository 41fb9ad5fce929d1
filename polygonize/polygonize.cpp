#include "polygonize/polygonize.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <mutex>
#include <tuple>
#include <vector>

#include <glm/common.hpp>

#include "polygonize/crease_closing.h"
#include "polygonize/lattice.h"
#include "polygonize/stitch.h"
#include "polygonize/surface_block.h"
#include "polygonize/unresolved_pieces.h"

namespace barkridge {

namespace {

// Share of the progress that finding the surface takes; stitching is the rest.
constexpr double kSearchShare = 0.98;

// The blocks that a box overlaps.
BlockRange blocks_of(const Lattice& lattice, const Box& box) {
  const double side = kBlockCells * lattice.cell_size;
  // A little more, against the rounding of the quotient.
  return {glm::ivec3(glm::floor(box.lo / side - 1e-6)), glm::ivec3(glm::floor(box.hi / side + 1e-6)) + 1};
}

bool is_before(const glm::ivec3& a, const glm::ivec3& b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); }

void sort_and_unite(std::vector<glm::ivec3>& blocks) {
  tbb::parallel_sort(blocks.begin(), blocks.end(), is_before);
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
}

// All blocks that the field's cells overlap, each once, in order. Cells follow the model, so neighbours name the same
// blocks again: doubles are dropped early.
std::vector<glm::ivec3> blocks_to_visit(const Lattice& lattice, const Field& field) {
  constexpr std::size_t kWorthUniting = std::size_t{1} << 22;
  std::vector<glm::ivec3> blocks;
  std::size_t united = 0;
  const std::unique_ptr<const SurfaceCells> cells = field.cells();
  for (std::size_t i = 0; i < cells->size(); ++i) {
    const BlockRange range = blocks_of(lattice, cells->box(i));
    for (int z = range.lo.z; z < range.hi.z; ++z) {
      for (int y = range.lo.y; y < range.hi.y; ++y) {
        for (int x = range.lo.x; x < range.hi.x; ++x) blocks.emplace_back(x, y, z);
      }
    }
    if (blocks.size() - united > kWorthUniting + united) {
      sort_and_unite(blocks);
      united = blocks.size();
    }
  }
  sort_and_unite(blocks);
  return blocks;
}

// The search for the surface in blocks, in parallel.
class SurfaceSearch {
 public:
  SurfaceSearch(const Lattice& lattice, const PolygonizeOptions& options) : lattice_(lattice), options_(options) {}

  void visit(const std::vector<glm::ivec3>& blocks, const Field& field) {
    constexpr std::size_t kGrain = 16;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size(), kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t i = range.begin(); i < range.end(); ++i) visit_block(blocks[i], field);
                        add_progress(static_cast<double>(range.size()) / static_cast<double>(blocks.size()));
                      });
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

  Box box_with_halo(const BlockRange& range) const {
    // A little more than the halo, so that rounding leaves no lattice point outside.
    return grown(box_of(lattice_, range), (kCreaseHalo + 0.01) * lattice_.cell_size);
  }

  void visit_block(const glm::ivec3& coordinates, const Field& field) {
    const BlockRange single{coordinates, coordinates + 1};
    const Box halo = box_with_halo(single), box = box_of(lattice_, single);
    const auto with_halo = field.restricted(halo);
    const Interval around = with_halo->bounds(halo).value;
    if (around.hi < kIsoValue || around.lo >= kIsoValue) return;
    const auto restricted = with_halo->restricted(box);
    const Interval value = restricted->bounds(box).value;
    if (value.hi < kIsoValue || value.lo >= kIsoValue) return;
    Local& local = locals_.local();
    std::optional<SurfaceBlock> block = sample_block(
        lattice_, *restricted, options_.close_creases ? with_halo.get() : nullptr, coordinates, local.scratch);
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
    search.visit(blocks_to_visit(lattice, field), field);
    mesh = stitch(search.take_blocks());
    if (options.close_creases) remove_unresolved_pieces(mesh, options.cell_size);
  }
  report(options.progress, 1);
  return mesh;
}

}  // namespace barkridge
