#pragma once
// Where in a picture the solid can be seen at all: most pixels of a tree's picture see only what is behind it.

#include <cstdint>
#include <vector>

#include "raytrace/camera.h"
#include "raytrace/tracer.h"

namespace barkridge {

/// Of the pixels of a region.
class SeenPixels {
 public:
  /// Marks the pixels whose filter may reach a part. Cost: in proportion to the parts and the pixels that they cover.
  SeenPixels(const Tracer& tracer, const CameraRays& camera, const PixelRegion& region);

  /// Whether a ray through the pixel's filter, of one pixel to either side of its centre, can meet a part.
  bool may_see(int x, int y) const { return all_ || marks_[index(x, y)] != 0; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - region_.y) * static_cast<std::size_t>(region_.width) +
           static_cast<std::size_t>(x - region_.x);
  }

  PixelRegion region_;
  bool all_ = false;
  std::vector<std::uint8_t> marks_;
};

}  // namespace barkridge
