#include "bench/support/surfaces.h"

#include <stdexcept>

namespace barkridge::bench {

TreeOptions surface_options(const std::string& surface) {
  constexpr double kBendDegrees = 25;
  TreeOptions options;
  if (surface == "smooth") {
    options.junction = JunctionKind::kSmooth;
  } else if (surface == "confined") {
    options.junction = JunctionKind::kSmooth;
    options.blending = BlendingKind::kConfined;
  } else if (surface == "bend") {
    options.bend_angle_degrees = kBendDegrees;
  } else if (surface != "ridge") {
    throw std::invalid_argument("no surface is called " + surface);
  }
  return options;
}

}  // namespace barkridge::bench
