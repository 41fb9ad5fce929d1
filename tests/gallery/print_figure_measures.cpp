// Prints the measures of all figures for bench/gallery, a line each: figure, what, measured, expected (empty where
// theory is silent), separated by tabs.

#include <fmt/format.h>

#include "tests/gallery/figure_measures.h"

using namespace barkridge::test;

int main() {
  const struct {
    const char* figure;
    FigureMeasures (*measure)();
  } figures[] = {{"7", measure_cone},          {"8", measure_bulge},      {"9", measure_shortened},
                 {"10", measure_turned},       {"11", measure_branching}, {"12", measure_displaced},
                 {"12", measure_ridge},        {"13", measure_collars},   {"14", measure_cuts},
                 {"15", measure_scars},        {"16", measure_bend},      {"17", measure_smooth_poplar},
                 {"18", measure_ridged_poplar}};
  for (const auto& [figure, measure] : figures) {
    for (const FigureMeasure& it : measure()) {
      const std::string expected = it.expected ? fmt::format("{:.{}f}", *it.expected + 0.0, it.digits) : "";
      fmt::print("{}\t{}\t{:.{}f}\t{}\n", figure, it.what, it.measured, it.digits, expected);
    }
  }
}
