// Prints the measures of all figures for bench/gallery, a line each: the figure's number, a tab, and the row of its
// table.

#include <fmt/format.h>

#include "tests/gallery/figure_measures.h"

int main() {
  for (const auto& [figure, measure] : barkridge::test::figure_meters()) {
    for (const auto& it : measure()) fmt::print("{}\t{}\n", figure, barkridge::test::table_row(it));
  }
}
