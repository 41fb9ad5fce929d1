#include "study/measurement.h"

#include <algorithm>

namespace barkridge {

namespace {

double cost(const Measurement& m) { return m.build.median + m.surface.median; }

void keep_cheaper(const Measurement*& best, const Measurement& candidate) {
  if (best == nullptr || cost(candidate) < cost(*best)) best = &candidate;
}

}  // namespace

Times times_of(std::vector<double> seconds) {
  if (seconds.empty()) return {};
  std::sort(seconds.begin(), seconds.end());
  const std::size_t half = seconds.size() / 2;
  const double median = seconds.size() % 2 == 1 ? seconds[half] : 0.5 * (seconds[half - 1] + seconds[half]);
  return {median, seconds.front(), seconds.back()};
}

double Measurement::triangles_per_second() const {
  return cost(*this) > 0 ? static_cast<double>(triangles) / cost(*this) : 0;
}

std::optional<double> Headline::ratio() const {
  if (implicit == nullptr || subdivision == nullptr || cost(*subdivision) <= 0) return std::nullopt;
  return cost(*implicit) / cost(*subdivision);
}

std::vector<Headline> headlines(std::span<const Measurement> measurements) {
  std::vector<Headline> found;
  for (const Measurement& m : measurements) {
    auto place = std::find_if(found.begin(), found.end(), [&](const Headline& h) { return h.model == m.model; });
    if (place == found.end()) place = found.insert(found.end(), Headline{m.model});
    if (!m.error || m.error->root_mean_square > kEqualQualityPixels) continue;
    if (m.method == kBaselineMethod) continue;
    keep_cheaper(m.method == kImplicitMethod ? place->implicit : place->subdivision, m);
  }
  return found;
}

}  // namespace barkridge
