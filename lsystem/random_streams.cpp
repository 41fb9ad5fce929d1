#include "lsystem/random_streams.h"

#include <algorithm>
#include <cmath>

namespace barkridge {

void RandomStreams::seed_uniform(std::int64_t seed) {
  uniform = Drand48::seeded(seed);
  has_spare_normal = false;
}

void RandomStreams::seed_choice(std::int64_t seed) {
  if (seed == 0) return;
  choice = Drand48((std::uint64_t{155} << 32) | (static_cast<std::uint64_t>(seed) & 0xFFFF));
}

double RandomStreams::normal(double mean, double deviation) {
  if (has_spare_normal) {
    has_spare_normal = false;
    return spare_normal * deviation + mean;
  }
  double x, y, square;
  do {
    x = 2.0 * uniform.next() - 1.0;
    y = 2.0 * uniform.next() - 1.0;
    square = x * x + y * y;
  } while (square >= 1.0 || square == 0.0);
  const double factor = std::sqrt(-2.0 * std::log(square) / square);
  spare_normal = x * factor;
  has_spare_normal = true;
  return y * factor * deviation + mean;
}

double RandomStreams::beta(double a, double b) {
  const auto next_above_zero = [this] {
    double value;
    do {
      value = uniform.next();
    } while (value == 0);
    return value;
  };
  const double s = a + b;
  const double lambda = std::min(a, b) <= 1 ? std::min(a, b) : std::sqrt((2 * a * b - s) / (s - 2));
  const double u = a + lambda;
  double v, y, u1, u2;
  do {
    u1 = next_above_zero();
    u2 = next_above_zero();
    v = (1 / lambda) * std::log(u1 / (1 - u1));
    y = a * std::exp(v);
  } while (s * std::log(s / (b + y)) + u * v - std::log(4) < std::log(u1 * u1 * u2));
  return y / (b + y);
}

double RandomStreams::binomial(int n, double p) {
  int heads = 0;
  for (int i = 0; i < n; ++i) heads += uniform.next() <= p;
  return heads;
}

}  // namespace barkridge
