#include <fmt/format.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <set>

#include "study/study.h"

namespace barkridge {

namespace {

using Cell = nlohmann::ordered_json;

Cell number_or_nothing(std::optional<double> x) { return x ? Cell(*x) : Cell(); }

ReportTable measurement_table(const StudyFindings& findings) {
  ReportTable table{"measurements",
                    "Every method at every resolution: medians of the runs, in processes of their own",
                    {"model", "method", "setting", "internodes", "skeleton s", "build s", "surface s", "total s",
                     "total least", "total most", "triangles", "triangles/s", "peak MB", "error (rms)",
                     "error (largest)", "error px (rms)", "error px (largest)", "crossing limbs", "crossings"},
                    {}};
  for (const Measurement& m : findings.measurements) {
    table.rows.push_back(
        {m.model, m.method, m.setting, m.internodes, m.skeleton.median, m.build.median, m.surface.median,
         m.total.median, m.total.least, m.total.most, m.triangles, m.triangles_per_second(),
         static_cast<double>(m.peak_bytes) / 1e6, m.error ? Cell(m.error->root_mean_square * m.pixel) : Cell(),
         m.error ? Cell(m.error->largest * m.pixel) : Cell(), m.error ? Cell(m.error->root_mean_square) : Cell(),
         m.error ? Cell(m.error->largest) : Cell(), m.crossing_limbs, m.crossings ? Cell(*m.crossings) : Cell()});
  }
  return table;
}

ReportTable headline_table(const StudyFindings& findings) {
  ReportTable table{"headline",
                    fmt::format("The cheapest setting of each path whose error is at most {} pixels (root mean square)",
                                kEqualQualityPixels),
                    {"model", "implicit", "implicit s", "subdivision", "subdivision s", "implicit/subdivision"},
                    {}};
  const auto name = [](const Measurement* m) {
    return m ? Cell(m->method + ", " + m->setting) : Cell("none measured is good enough");
  };
  const auto cost = [](const Measurement* m) { return m ? Cell(m->build.median + m->surface.median) : Cell(); };
  for (const Headline& h : headlines(findings.measurements)) {
    table.rows.push_back({h.model, name(h.implicit), cost(h.implicit), name(h.subdivision), cost(h.subdivision),
                          number_or_nothing(h.ratio())});
  }
  return table;
}

// [MacM04, Table 8.1], on a dual Pentium III of 733 MHz.
ReportTable published_table() {
  return {"published",
          "What was published in 2004: the thesis' Table 8.1, two processors of 733 MHz; \"over thirty times faster\"",
          {"model", "method", "s", "triangles", "triangles/s"},
          {{"Scars", "implicit", 115.28, 726964, 6306.07},
           {"Scars", "subdivision, 2 levels", 3.05, 153280, 50255.74},
           {"Scars", "subdivision, 3 levels", 12.84, 613120, 47750.78},
           {"No scars", "implicit", 46.38, 294528, 6350.32},
           {"No scars", "subdivision, 2 levels", 1.43, 73632, 49088.00},
           {"No scars", "subdivision, 3 levels", 6.28, 294528, 46899.36}}};
}

std::vector<std::string> methods_of(const StudyFindings& findings) {
  std::vector<std::string> methods;
  for (const Measurement& m : findings.measurements) {
    if (std::find(methods.begin(), methods.end(), m.method) == methods.end()) methods.push_back(m.method);
  }
  return methods;
}

double cost(const Measurement& m) { return m.build.median + m.surface.median; }

Plot error_plot(const StudyFindings& findings, const std::string& model) {
  Plot plot{"Error against time: " + model, "seconds, building and surface", "error in pixels (root mean square)", {}};
  for (const std::string& method : methods_of(findings)) {
    PlotSeries series{method, {}};
    for (const Measurement& m : findings.measurements) {
      if (m.model == model && m.method == method && m.error) {
        series.points.emplace_back(cost(m), m.error->root_mean_square);
      }
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

// How cost grows with the plant: the thesis' resolution of two levels, and cells of half the thinnest radius.
Plot growth_plot(const StudyFindings& findings) {
  Plot plot{"Time against size", "internodes", "seconds, building and surface", {}};
  for (const std::string& method : methods_of(findings)) {
    const std::string setting = StudySetting{method, 0.5, 2}.name();
    PlotSeries series{method + ", " + setting, {}};
    for (const Measurement& m : findings.measurements) {
      if (m.method == method && m.setting == setting) {
        series.points.emplace_back(static_cast<double>(m.internodes), cost(m));
      }
    }
    std::sort(series.points.begin(), series.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

Report report_of(const StudyFindings& findings, const std::vector<StudyScene>& scenes,
                 const std::vector<std::pair<std::string, std::string>>& facts) {
  Report report{"Implicit surfaces and subdivision surfaces of trees", facts, {}};
  ReportSection headline{"Equal quality", {}, {headline_table(findings), published_table()}, {}, {}};
  headline.paragraphs = {fmt::format(
      "An error is the two-sided distance between a surface and one ten times finer of the same method (cells a "
      "tenth as wide, or four levels more), measured at places drawn over the plant, half of them at forks, and "
      "counted in "
      "pixels of a picture in which the plant's largest extent has {:.0f}. Qualities are equal where the root mean "
      "square is "
      "within {} of a pixel; times are of building and surface.",
      kErrorPixels, kEqualQualityPixels)};
  report.sections.push_back(std::move(headline));

  ReportSection all{
      "All measurements",
      {"Errors are in the model's unit and in pixels (px). Crossing limbs are pairs of internodes without a "
       "common end whose axes come nearer than the sum of their radii: what dresses each by itself must "
       "cross there. Crossings are pairs of triangles that do."},
      {measurement_table(findings)},
      {growth_plot(findings)},
      {}};
  all.paragraphs.insert(all.paragraphs.end(), findings.notes.begin(), findings.notes.end());
  for (const StudyScene& scene : scenes) all.plots.push_back(error_plot(findings, scene.name));
  report.sections.push_back(std::move(all));

  ReportSection models{"The models", {}, {}, {}, findings.pictures};
  for (const StudyScene& scene : scenes) models.paragraphs.push_back(scene.name + ": " + scene.meaning);
  report.sections.push_back(std::move(models));
  return report;
}

}  // namespace barkridge
