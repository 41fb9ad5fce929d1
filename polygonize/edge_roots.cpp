#include "polygonize/edge_roots.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace barkridge {

namespace {

// Rounds that trust interpolation alone.
constexpr int kTrustingRounds = 8;

// Below this, the moving end has hardly moved.
constexpr double kLeastWeight = 0.1;

bool is_inside(double value) { return value >= 0; }

// Where to look next: at the root of the line through both ends, or in the middle, by turns once interpolation has had
// its chance. An end with exactly the iso-value says nothing about where the solid ends, which may be at once or after
// a stretch of iso-value; so there, too, it is by turns beside that end and in the middle.
double next_probe(EdgeCrossing& c, int round, double tolerance) {
  const auto& [lo, hi] = c.ends;
  const double middle = 0.5 * (lo.coordinate + hi.coordinate);
  if (round >= kTrustingRounds || lo.value == 0 || hi.value == 0) {
    c.halves_next = !c.halves_next;
    if (!c.halves_next) return middle;
  }
  const double at_lo = lo.weight * lo.value, at_hi = hi.weight * hi.value;
  const double guess = lo.coordinate + (hi.coordinate - lo.coordinate) * (at_lo / (at_lo - at_hi));
  if (std::isnan(guess)) return middle;
  // A step of less than the tolerance would leave the bracket open on the far side.
  const double step = std::min(0.5 * tolerance, middle - lo.coordinate);
  return std::clamp(guess, lo.coordinate + step, hi.coordinate - step);
}

// Takes in the field minus iso-value at `probe`; returns whether the root is known.
bool advance(EdgeCrossing& c, double probe, double value, double tolerance) {
  const int moved = is_inside(value) == is_inside(c.ends[0].value) ? 0 : 1;
  EdgeCrossing::End& moving = c.ends[moved];
  EdgeCrossing::End& staying = c.ends[1 - moved];
  const EdgeCrossing::End replaced = moving;
  // An end that stays a second time counts for less, so that it will move soon. [Anderson and Bjoerck 1973]
  if (c.last_moved == moved) {
    const double weight = 1 - value / replaced.value;
    staying.weight *= weight > kLeastWeight ? weight : 0.5;
  }
  c.last_moved = moved;
  moving = {probe, value, 1};
  c.point[c.axis] = probe;
  if (std::abs(staying.coordinate - probe) <= tolerance) return true;
  // The step to the root by the secant of this end's last two places.
  return value != 0 && std::abs(value * (probe - replaced.coordinate)) <= tolerance * std::abs(replaced.value - value);
}

}  // namespace

void find_roots(const Field& field, double tolerance, std::span<EdgeCrossing> crossings, RootScratch& scratch) {
  auto& [active, points, values] = scratch;
  active.resize(crossings.size());
  std::iota(active.begin(), active.end(), 0u);
  for (int round = 0; !active.empty(); ++round) {
    points.resize(active.size());
    values.resize(active.size());
    for (std::size_t i = 0; i < active.size(); ++i) {
      EdgeCrossing& c = crossings[active[i]];
      points[i] = c.point;
      points[i][c.axis] = next_probe(c, round, tolerance);
    }
    field.values(points, values);
    std::size_t left = 0;
    for (std::size_t i = 0; i < active.size(); ++i) {
      EdgeCrossing& c = crossings[active[i]];
      if (!advance(c, points[i][c.axis], values[i] - kIsoValue, tolerance)) active[left++] = active[i];
    }
    active.resize(left);
  }
  for (EdgeCrossing& c : crossings) c.point[c.axis] = std::clamp(c.point[c.axis], c.least, c.most);
}

}  // namespace barkridge
