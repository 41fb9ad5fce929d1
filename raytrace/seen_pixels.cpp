#include "raytrace/seen_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace barkridge {

namespace {

// A rectangle of the picture; all of it where a corner is not before the camera.
struct Rectangle {
  Interval x, y;
  bool is_known = true;
};

Rectangle seen_rectangle(const Box& box, const CameraRays& camera) {
  Rectangle seen;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 point(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                     corner & 4 ? box.hi.z : box.lo.z);
    const std::optional<glm::dvec2> place = camera.place_of(point);
    if (!place) return {{}, {}, false};
    seen.x = {std::min(seen.x.lo, place->x), std::max(seen.x.hi, place->x)};
    seen.y = {std::min(seen.y.lo, place->y), std::max(seen.y.hi, place->y)};
  }
  return seen;
}

// The pixels from `first` on, `count` of them, whose filters reach into an interval.
glm::ivec2 pixels_that_reach(const Interval& interval, int first, int count) {
  // The filter reaches from half a pixel before the pixel to half a pixel past it; some more, against rounding.
  constexpr double kMargin = 1e-3;
  const double from = std::ceil(interval.lo - 1.5 - kMargin), to = std::floor(interval.hi + 0.5 + kMargin);
  return {static_cast<int>(std::clamp<double>(from, first, first + count)),
          static_cast<int>(std::clamp<double>(to, first - 1, first + count - 1))};
}

}  // namespace

SeenPixels::SeenPixels(const Tracer& tracer, const CameraRays& camera, const PixelRegion& region)
    : region_(region), marks_(static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height)) {
  std::atomic<bool> all = false;
  tbb::parallel_for(std::size_t{0}, tracer.part_count(), [&](std::size_t part) {
    const Rectangle seen = seen_rectangle(tracer.part(part), camera);
    if (!seen.is_known) all.store(true, std::memory_order_relaxed);
    if (all.load(std::memory_order_relaxed)) return;
    const glm::ivec2 columns = pixels_that_reach(seen.x, region.x, region.width),
                     rows = pixels_that_reach(seen.y, region.y, region.height);
    for (int y = rows.x; y <= rows.y; ++y) {
      for (int x = columns.x; x <= columns.y; ++x) {
        std::atomic_ref<std::uint8_t>(marks_[index(x, y)]).store(1, std::memory_order_relaxed);
      }
    }
  });
  all_ = all;
}

}  // namespace barkridge
