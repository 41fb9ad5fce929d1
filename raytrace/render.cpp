#include "raytrace/render.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "base/large_room.h"
#include "raytrace/camera.h"
#include "raytrace/path.h"
#include "raytrace/sampler.h"
#include "raytrace/seen_pixels.h"
#include "raytrace/tracer.h"

namespace barkridge {

namespace {

constexpr int kTileSize = 128;
// Every pixel gets as many; whether it gets more depends on them and on those of its neighbours.
constexpr int kFirstSamples = 4;
// A pixel unlike a neighbour gets at least as many.
constexpr int kEdgeSamples = 16;
// Neighbours are sampled together, in squares of so many pixels a side.
constexpr int kBlockSize = 4;
// Both in display units, where 1 is white and eyes see differences alike: the standard error at which a pixel is done,
// and the difference that makes neighbours unlike.
constexpr double kNoiseGoal = 1.0 / 256;
constexpr double kUnlike = 1.0 / 32;

// The layers that every picture with layers has.
constexpr std::array<const char*, 6> kOwnLayers{"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"};

// What the samples of a pixel add up to, in their order.
struct PixelSum {
  Color color{0};
  double alpha = 0;
  double shade = 0, shade_squared = 0;  // of brightness in display units
  int count = 0;

  void add(const Radiance& sample) {
    const bool finite = std::isfinite(sample.color.x + sample.color.y + sample.color.z + sample.alpha);
    const Radiance s = finite ? sample : Radiance{};
    const double luminance = 0.2126 * s.color.x + 0.7152 * s.color.y + 0.0722 * s.color.z;
    const double display = std::sqrt(std::clamp(luminance, 0.0, 1.0)) + s.alpha;
    color += s.color;
    alpha += s.alpha;
    shade += display;
    shade_squared += display * display;
    ++count;
  }
  double mean_shade() const { return shade / count; }
  // The square of the standard error of the mean, as if the samples were independent.
  double error_squared() const {
    const double mean = mean_shade();
    return std::max(0.0, shade_squared / count - mean * mean) / std::max(1, count - 1);
  }
};

// The pixels from `first` on, up to `last`, which is not one of them.
struct PixelRange {
  glm::ivec2 first, last;

  PixelRange(const glm::ivec2& from, const glm::ivec2& to) : first(from), last(to) {}
  explicit PixelRange(const PixelRegion& r) : first(r.x, r.y), last(r.x + r.width, r.y + r.height) {}

  glm::ivec2 size() const { return last - first; }
  PixelRegion region() const { return {first.x, first.y, size().x, size().y}; }
  bool contains(int x, int y) const { return first.x <= x && x < last.x && first.y <= y && y < last.y; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - first.y) * static_cast<std::size_t>(size().x) +
           static_cast<std::size_t>(x - first.x);
  }
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (int y = first.y; y < last.y; ++y) {
      for (int x = first.x; x < last.x; ++x) visit(x, y);
    }
  }
};

// Of the pixels of a tile and some around it.
class PixelSums {
 public:
  explicit PixelSums(const PixelRange& pixels)
      : pixels_(pixels), sums_(static_cast<std::size_t>(pixels.size().x) * static_cast<std::size_t>(pixels.size().y)) {}

  const PixelRange& pixels() const { return pixels_; }
  PixelSum& at(int x, int y) { return sums_[pixels_.index(x, y)]; }
  const PixelSum& at(int x, int y) const { return sums_[pixels_.index(x, y)]; }

  // Whether a pixel is unlike one beside it.
  bool is_edge(int x, int y) const {
    const double shade = at(x, y).mean_shade();
    bool edge = false;
    PixelRange(glm::max(glm::ivec2(x - 1, y - 1), pixels_.first), glm::min(glm::ivec2(x + 2, y + 2), pixels_.last))
        .for_each([&](int u, int v) { edge = edge || std::abs(at(u, v).mean_shade() - shade) > kUnlike; });
    return edge;
  }

 private:
  PixelRange pixels_;
  std::vector<PixelSum> sums_;
};

class TileRenderer {
 public:
  TileRenderer(const Tracer& tracer, const RenderScene& scene, const RenderOptions& options, const PixelRegion& region)
      : options_(options),
        picture_(PixelRegion{0, 0, options.width, options.height}),
        camera_(scene.camera, options.width, options.height),
        path_(tracer, scene, camera_.footprint(), options.bounces),
        layout_(options.seed, options.width, options.height, options.samples_per_pixel),
        seen_(tracer, camera_, sampled_for(PixelRange(region)).region()),
        plain_background_(path_.plain_background()),
        layers_(scene.layers.get()) {}

  // Renders the pixels of `tile`, and the first samples of those around it, which decide about further ones.
  void render(const PixelRange& tile, Image& image) const {
    PixelSums first(sampled_for(tile));
    for_each_block(first.pixels(), [&](const PixelRange& block) {
      BlockSums sums(block);
      add_samples(sums, [](const PixelSum&, int, int) { return kFirstSamples; });
      sums.for_each([&](const PixelSum& sum, int x, int y) { first.at(x, y) = sum; });
    });
    for_each_block(tile, [&](const PixelRange& block) {
      BlockSums sums(block);
      sums.for_each([&](PixelSum& sum, int x, int y) { sum = first.at(x, y); });
      finish(sums, first);
      sums.for_each([&](const PixelSum& sum, int x, int y) {
        if (!tile.contains(x, y)) return;
        store(sum, x, y, image);
        if (layers_) store_layers(x, y, image);
      });
    });
  }

 private:
  // Of the pixels of a block.
  class BlockSums {
   public:
    explicit BlockSums(const PixelRange& pixels) : pixels_(pixels) {}

    // In squares of two by two, whose rays follow each other.
    template <typename Visit>
    void for_each(const Visit& visit) {
      const auto [first, last] = pixels_;
      for (int v = first.y; v < last.y; v += 2) {
        for (int u = first.x; u < last.x; u += 2) {
          PixelRange({u, v}, glm::min(glm::ivec2(u + 2, v + 2), last)).for_each([&](int x, int y) {
            visit(sums_[pixels_.index(x, y)], x, y);
          });
        }
      }
    }

   private:
    PixelRange pixels_;
    std::array<PixelSum, kBlockSize * kBlockSize> sums_;
  };

  // Pixels are sampled in blocks of the whole picture, so that the rays that are traced together are the same ones
  // whatever the region and the tiles. Rows of blocks can be taken over by threads that have no tile left.
  template <typename Visit>
  void for_each_block(const PixelRange& pixels, const Visit& visit) const {
    const glm::ivec2 first = pixels.first / kBlockSize, last = (pixels.last + kBlockSize - 1) / kBlockSize;
    tbb::parallel_for(first.y, last.y, [&](int row) {
      for (int column = first.x; column < last.x; ++column) {
        const glm::ivec2 corner = kBlockSize * glm::ivec2(column, row);
        visit(PixelRange(corner, glm::min(corner + kBlockSize, picture_.last)));
      }
    });
  }

  // The pixels whose first samples are needed for some: those of their blocks, and of the blocks beside these.
  PixelRange sampled_for(const PixelRange& pixels) const {
    const int size = kBlockSize, margin = options_.samples_per_pixel > kFirstSamples ? size : 0;
    return {glm::max(size * (pixels.first / size) - margin, glm::ivec2(0)),
            glm::min(size * ((pixels.last + size - 1) / size) + margin, picture_.last)};
  }

  void finish(BlockSums& sums, const PixelSums& first) const {
    add_samples(sums,
                [&](const PixelSum& sum, int x, int y) { return first.is_edge(x, y) ? kEdgeSamples : sum.count; });
    const auto until_steady = [](const PixelSum& sum, int, int) {
      return sum.error_squared() > kNoiseGoal * kNoiseGoal ? 2 * sum.count : sum.count;
    };
    while (add_samples(sums, until_steady)) {
    }
  }

  // Goes on until every pixel has as many samples as are wanted of it, or as many as allowed; returns whether any were
  // missing.
  template <typename Wanted>
  bool add_samples(BlockSums& sums, const Wanted& wanted) const {
    thread_local std::vector<PixelSample> samples;
    thread_local std::vector<PixelSum*> owners;
    thread_local std::vector<Radiance> radiances;
    samples.clear();
    owners.clear();
    std::array<std::optional<PixelSampler>, kBlockSize * kBlockSize> samplers;
    std::size_t pixel = 0;
    bool any = false;
    sums.for_each([&](PixelSum& sum, int x, int y) {
      const int count = std::min(wanted(sum, x, y), options_.samples_per_pixel);
      if (sum.count >= count) return;
      any = true;
      const bool meets_solid = seen_.may_see(x, y);
      if (!meets_solid && plain_background_) {
        while (sum.count < count) sum.add(*plain_background_);
        return;
      }
      const PixelSampler& sampler = samplers[pixel++].emplace(layout_, x, y);
      for (int number = sum.count; number < count; ++number) {
        const glm::dvec2 u = sampler.pair(number, Dimension::kPixel);
        samples.push_back({camera_.through(x + 0.5 + tent(u.x), y + 0.5 + tent(u.y)), &sampler, number, meets_solid});
        owners.push_back(&sum);
      }
    });
    radiances.resize(samples.size());
    path_.along(samples, radiances);
    for (std::size_t i = 0; i < samples.size(); ++i) owners[i]->add(radiances[i]);
    return any;
  }

  // Importance sampling of the pixel filter, a tent one pixel to either side: a sample belongs to one pixel only.
  static double tent(double u) { return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

  static std::size_t place_in(const Image& image, int x, int y) {
    const std::size_t row = static_cast<std::size_t>(y - image.region.y);
    return row * static_cast<std::size_t>(image.region.width) + static_cast<std::size_t>(x - image.region.x);
  }

  // Layers are not mixed over a pixel: the mean of two internodes' numbers is no internode's.
  void store_layers(int x, int y, Image& image) const {
    const std::optional<Hit> hit =
        seen_.may_see(x, y) ? path_.solid_along(camera_.through(x + 0.5, y + 0.5)) : std::nullopt;
    if (!hit) return;
    const std::size_t count = image.layer_names.size();
    const std::span<float> values = std::span(image.layers).subspan(count * place_in(image, x, y), count);
    for (int axis = 0; axis < 3; ++axis) {
      values[static_cast<std::size_t>(axis)] = static_cast<float>(hit->point[axis]);
      values[static_cast<std::size_t>(axis) + 3] = static_cast<float>(hit->normal[axis]);
    }
    layers_->values(hit->point, values.subspan(kOwnLayers.size()));
  }

  static void store(const PixelSum& sum, int x, int y, Image& image) {
    float* pixel = &image.rgba[4 * place_in(image, x, y)];
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(sum.color[c] / sum.count);
    pixel[3] = static_cast<float>(sum.alpha / sum.count);
  }

  const RenderOptions& options_;
  PixelRange picture_;
  CameraRays camera_;
  PathTracer path_;
  SampleLayout layout_;
  SeenPixels seen_;
  std::optional<Radiance> plain_background_;
  const SurfaceLayers* layers_;
};

// Tells how much is done, from one thread at a time.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}

  void add(std::size_t amount) {
    const std::lock_guard lock(mutex_);
    done_ += amount;
    report(progress_, static_cast<double>(done_) / static_cast<double>(total_));
  }

 private:
  const Progress& progress_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

Image render_traced(const Tracer& tracer, const RenderScene& scene, const RenderOptions& options) {
  Image image{options.width, options.height, options.region, {}};
  if (scene.layers) {
    image.layer_names.assign(kOwnLayers.begin(), kOwnLayers.end());
    for (std::string& name : scene.layers->names()) image.layer_names.push_back(std::move(name));
  }
  if (image.region.width == 0) image.region = {0, 0, options.width, options.height};
  const PixelRegion& region = image.region;
  const std::size_t pixels = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
  resize_large(image.rgba, 4 * pixels);
  resize_large(image.layers, image.layer_names.size() * pixels);

  const TileRenderer renderer(tracer, scene, options, region);
  SharedProgress progress(options.progress, pixels);
  const tbb::blocked_range2d<int> tiles(0, (region.height + kTileSize - 1) / kTileSize, 1, 0,
                                        (region.width + kTileSize - 1) / kTileSize, 1);
  tbb::parallel_for(
      tiles,
      [&](const tbb::blocked_range2d<int>& range) {
        for (int row = range.rows().begin(); row < range.rows().end(); ++row) {
          for (int column = range.cols().begin(); column < range.cols().end(); ++column) {
            const int x = column * kTileSize, y = row * kTileSize;
            const PixelRegion tile{region.x + x, region.y + y, std::min(kTileSize, region.width - x),
                                   std::min(kTileSize, region.height - y)};
            renderer.render(PixelRange(tile), image);
            progress.add(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height));
          }
        }
      },
      tbb::simple_partitioner());
  return image;
}

}  // namespace

Image render(const Field& field, const RenderScene& scene, const RenderOptions& options) {
  check(scene);
  check(options);
  return render_traced(Tracer(field, options.progress), scene, options);
}

Image render(const Mesh& mesh, const RenderScene& scene, const RenderOptions& options) {
  check(scene);
  check(options);
  return render_traced(Tracer(mesh, options.progress), scene, options);
}

}  // namespace barkridge
