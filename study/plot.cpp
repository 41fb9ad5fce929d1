#include "study/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry.h"
#include "study/markup.h"

namespace barkridge {

namespace {

constexpr double kWidth = 680, kHeight = 420;
constexpr double kLeft = 72, kRight = 210, kTop = 34, kBottom = 48;
// Okabe and Ito's colours, which people tell apart who see few.
constexpr std::array kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

bool is_drawn(const glm::dvec2& p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); }

// An axis over whole decades.
struct Axis {
  double first = 0, last = 1;  // exponents of ten
  double from = 0, to = 1;     // where they lie

  double place(double value) const { return from + (to - from) * (std::log10(value) - first) / (last - first); }
};

Axis axis_over(const Interval& values, double from, double to) {
  Axis axis{std::floor(std::log10(values.lo) + 1e-9), std::ceil(std::log10(values.hi) - 1e-9), from, to};
  if (axis.last <= axis.first) axis.last = axis.first + 1;
  return axis;
}

std::string decade_name(double exponent) {
  if (exponent >= 0 && exponent <= 3) return fmt::format("{:.0f}", std::pow(10, exponent));
  if (exponent >= -3 && exponent < 0)
    return fmt::format("{:.{}f}", std::pow(10, exponent), static_cast<int>(-exponent));
  return fmt::format("1e{:.0f}", exponent);
}

std::string text(double x, double y, const char* anchor, const std::string& content, const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, anchor, more,
                     escaped(content));
}

std::string line(double x0, double y0, double x1, double y1, const char* style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0, y0, x1, y1, style);
}

std::string grid(const Axis& x, const Axis& y) {
  std::string out;
  constexpr const char* kMajor = "stroke=\"#ccc\"";
  constexpr const char* kMinor = "stroke=\"#eee\"";
  for (const bool major : {false, true}) {
    const auto draw = [&](const Axis& axis, const auto& stroke) {
      for (double exponent = axis.first; exponent <= axis.last; ++exponent) {
        if (major) stroke(std::pow(10, exponent), kMajor);
        for (int digit = 2; digit < 10 && !major && exponent < axis.last; ++digit) {
          stroke(digit * std::pow(10, exponent), kMinor);
        }
      }
    };
    draw(x, [&](double v, const char* style) { out += line(x.place(v), y.from, x.place(v), y.to, style); });
    draw(y, [&](double v, const char* style) { out += line(x.from, y.place(v), x.to, y.place(v), style); });
  }
  for (double e = x.first; e <= x.last; ++e)
    out += text(x.place(std::pow(10, e)), y.from + 16, "middle", decade_name(e));
  for (double e = y.first; e <= y.last; ++e)
    out += text(x.from - 6, y.place(std::pow(10, e)) + 4, "end", decade_name(e));
  return out;
}

std::string mark(std::size_t series, double x, double y, const char* color) {
  switch (series % 3) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x, y, color);
    case 1:
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6.4\" height=\"6.4\" fill=\"{}\"/>\n", x - 3.2,
                         y - 3.2, color);
    default:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4 7h-8z\" fill=\"{}\"/>\n", x, y - 4, color);
  }
}

std::string curve(const PlotSeries& series, std::size_t index, const Axis& x, const Axis& y) {
  const char* const color = kColors[index % kColors.size()];
  std::string path, marks;
  for (const glm::dvec2& point : series.points) {
    if (!is_drawn(point)) continue;
    const double px = x.place(point.x), py = y.place(point.y);
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
    marks += mark(index, px, py, color);
  }
  if (!series.is_line || path.empty()) return marks;
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", path, color) + marks;
}

}  // namespace

std::string svg(const Plot& plot) {
  Interval xs, ys;
  for (const PlotSeries& series : plot.series) {
    for (const glm::dvec2& point : series.points) {
      if (!is_drawn(point)) continue;
      xs = {std::min(xs.lo, point.x), std::max(xs.hi, point.x)};
      ys = {std::min(ys.lo, point.y), std::max(ys.hi, point.y)};
    }
  }
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\" role=\"img\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      kWidth, kHeight, escaped(plot.title));
  out += text(kLeft, 20, "start", plot.title, "font-size=\"14\" font-weight=\"bold\"");
  if (xs.empty()) return out + text(kWidth / 2, kHeight / 2, "middle", "nothing to show") + "</svg>\n";

  const Axis x = axis_over(xs, kLeft, kWidth - kRight), y = axis_over(ys, kHeight - kBottom, kTop);
  out += grid(x, y);
  out += text((x.from + x.to) / 2, kHeight - 10, "middle", plot.x_label);
  out += fmt::format("<g transform=\"translate(16 {:.1f}) rotate(-90)\">{}</g>\n", (y.from + y.to) / 2,
                     text(0, 0, "middle", plot.y_label));
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    out += curve(plot.series[i], i, x, y);
    const double row = kTop + 10 + 18 * static_cast<double>(i);
    out +=
        mark(i, x.to + 14, row - 4, kColors[i % kColors.size()]) + text(x.to + 24, row, "start", plot.series[i].name);
  }
  return out + "</svg>\n";
}

}  // namespace barkridge
