#include "tests/gallery/figure_measures.h"

#include <fmt/format.h>

namespace barkridge::test {

std::string table_row(const FigureMeasure& measure) {
  const std::string expected = measure.expected ? fmt::format("{:.{}f}", *measure.expected, measure.digits) : "";
  return fmt::format("| {} | {:.{}f} | {} |", measure.what, measure.measured, measure.digits, expected);
}

const std::vector<FigureMeter>& figure_meters() {
  static const std::vector<FigureMeter> meters{
      {"7", measure_cone},          {"8", measure_bulge},      {"9", measure_shortened}, {"10", measure_turned},
      {"11", measure_branching},    {"12", measure_displaced}, {"12", measure_ridge},    {"13", measure_collars},
      {"14", measure_cuts},         {"15", measure_scars},     {"16", measure_bend},     {"17", measure_smooth_poplar},
      {"18", measure_ridged_poplar}};
  return meters;
}

}  // namespace barkridge::test
