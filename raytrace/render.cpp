#include "raytrace/render.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>

#include "base/large_room.h"
#include "raytrace/camera.h"
#include "raytrace/path.h"
#include "raytrace/sampler.h"
#include "raytrace/seen_pixels.h"
#include "raytrace/tracer.h"

namespace barkridge {

namespace {

constexpr int kTileSize = 64;
// Every pixel gets as many; whether it gets more depends on them and on those of its neighbours.
constexpr int kFirstSamples = 4;
// A pixel unlike a neighbour gets at least as many.
constexpr int kEdgeSamples = 16;
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

class TileRenderer {
 public:
  TileRenderer(const Tracer& tracer, const RenderScene& scene, const RenderOptions& options, const PixelRegion& region)
      : options_(options),
        camera_(scene.camera, options.width, options.height),
        path_(tracer, scene, camera_.footprint(), options.bounces),
        layout_(options.seed, options.width, options.height, options.samples_per_pixel),
        seen_(tracer, camera_, with_neighbours(region)),
        plain_background_(path_.plain_background()),
        layers_(scene.layers.get()) {}

  // Renders the pixels of `tile`, and the first samples of those around it, which decide about further ones.
  void render(const PixelRegion& tile, Image& image) const {
    const PixelRegion sampled = options_.samples_per_pixel > kFirstSamples ? with_neighbours(tile) : tile;
    const int x0 = sampled.x, x1 = sampled.x + sampled.width, y0 = sampled.y, y1 = sampled.y + sampled.height;
    const std::size_t stride = static_cast<std::size_t>(x1 - x0);
    std::vector<PixelSum> first(stride * static_cast<std::size_t>(y1 - y0));
    const auto at = [&](int x, int y) -> PixelSum& {
      return first[static_cast<std::size_t>(y - y0) * stride + static_cast<std::size_t>(x - x0)];
    };
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) add_samples(x, y, kFirstSamples, at(x, y));
    }
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        PixelSum sum = at(x, y);
        bool edge = false;
        for (int v = std::max(y - 1, y0); v <= std::min(y + 1, y1 - 1) && sum.count < options_.samples_per_pixel; ++v) {
          for (int u = std::max(x - 1, x0); u <= std::min(x + 1, x1 - 1); ++u) {
            edge = edge || std::abs(at(u, v).mean_shade() - at(x, y).mean_shade()) > kUnlike;
          }
        }
        if (edge) add_samples(x, y, kEdgeSamples, sum);
        while (sum.count < options_.samples_per_pixel && sum.error_squared() > kNoiseGoal * kNoiseGoal) {
          add_samples(x, y, 2 * sum.count, sum);
        }
        store(sum, x, y, image);
        if (layers_) store_layers(x, y, image);
      }
    }
  }

 private:
  PixelRegion with_neighbours(const PixelRegion& region) const {
    const int x = std::max(0, region.x - 1), y = std::max(0, region.y - 1);
    return {x, y, std::min(options_.width, region.x + region.width + 1) - x,
            std::min(options_.height, region.y + region.height + 1) - y};
  }

  // Goes on until there are `count` samples, or as many as allowed.
  void add_samples(int x, int y, int count, PixelSum& sum) const {
    const int wanted = std::min(count, options_.samples_per_pixel);
    const bool meets_solid = seen_.may_see(x, y);
    if (!meets_solid && plain_background_) {
      while (sum.count < wanted) sum.add(*plain_background_);
      return;
    }
    const PixelSampler sampler(layout_, x, y);
    while (sum.count < wanted) {
      const glm::dvec2 u = sampler.pair(sum.count, Dimension::kPixel);
      const Ray ray = camera_.through(x + 0.5 + tent(u.x), y + 0.5 + tent(u.y));
      sum.add(path_.along(ray, sampler, sum.count, meets_solid));
    }
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
            renderer.render(tile, image);
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
