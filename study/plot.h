#pragma once
// Line plots on logarithmic axes, as SVG.

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace barkridge {

struct PlotSeries {
  std::string name;
  std::vector<glm::dvec2> points;  ///< in the order in which they are joined
  bool is_line = true;             ///< or loose marks
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotSeries> series;
};

/// A figure of fixed size with axes, decades, a key and a series in a colour and mark each; points whose coordinates
/// are not above 0 and finite are left out. Without points it says so. A whole `<svg>` element that needs no other
/// file.
std::string svg(const Plot& plot);

}  // namespace barkridge
