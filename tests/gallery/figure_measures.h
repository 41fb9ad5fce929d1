#pragma once
// A number for every phenomenon that the figures show, measured on the scenes of scenes/figures/ and scenes/
// themselves, beside what theory says of it. The tests hold the two together, and docs/gallery.md prints them.

#include <optional>
#include <string>
#include <vector>

namespace barkridge::test {

struct FigureMeasure {
  std::string what;  ///< with its unit
  double measured = 0;
  /// From closed forms, evaluated apart from the program's field; nothing where there are none.
  std::optional<double> expected;
  double tolerance = 1e-6;
  int digits = 3;  ///< after the point, for print
};
using FigureMeasures = std::vector<FigureMeasure>;

/// The measure as a row of docs/gallery.md: `| what | measured | expected |`.
std::string table_row(const FigureMeasure& measure);

/// The measures of a figure.
struct FigureMeter {
  const char* figure;  ///< its number
  FigureMeasures (*measure)();
};
/// All that there are, in the order of the figures.
const std::vector<FigureMeter>& figure_meters();

FigureMeasures measure_cone();           ///< figure 7
FigureMeasures measure_bulge();          ///< figure 8
FigureMeasures measure_shortened();      ///< figure 9
FigureMeasures measure_turned();         ///< figure 10
FigureMeasures measure_branching();      ///< figure 11
FigureMeasures measure_displaced();      ///< figure 12: bulges
FigureMeasures measure_ridge();          ///< figure 12: the ridge of the right panel
FigureMeasures measure_collars();        ///< figure 13
FigureMeasures measure_cuts();           ///< figure 14
FigureMeasures measure_scars();          ///< figure 15
FigureMeasures measure_bend();           ///< figure 16
FigureMeasures measure_smooth_poplar();  ///< figure 17
FigureMeasures measure_ridged_poplar();  ///< figure 18

}  // namespace barkridge::test
