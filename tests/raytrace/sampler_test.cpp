#include "raytrace/sampler.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <utility>

using namespace barkridge;

TEST_CASE("samples of a pixel fill every elementary interval once") {
  const SampleLayout layout(3, 300, 200, 64);
  for (const Dimension dimension : {Dimension::kPixel, Dimension::kBounce}) {
    for (int i = 0; i < 50; ++i) {
      const PixelSampler sampler(layout, 7 * i % 300, 13 * i % 200);
      for (const int count : {4, 16, 64}) {
        const int bits = static_cast<int>(std::log2(count));
        for (int across = 0; across <= bits; ++across) {
          std::set<std::pair<int, int>> cells;
          for (int s = 0; s < count; ++s) {
            const glm::dvec2 u = sampler.pair(s, dimension);
            REQUIRE((u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
            cells.emplace(static_cast<int>(std::ldexp(u.x, across)), static_cast<int>(std::ldexp(u.y, bits - across)));
          }
          REQUIRE(cells.size() == static_cast<std::size_t>(count));
        }
      }
    }
  }
}

TEST_CASE("single samples of a block of pixels are stratified over the block") {
  const SampleLayout layout(5, 64, 64, 1);
  for (int block = 0; block < 16; ++block) {
    std::set<std::pair<int, int>> cells;
    for (int i = 0; i < 16; ++i) {
      const PixelSampler sampler(layout, 4 * block % 64 + i % 4, i / 4);
      const glm::dvec2 u = sampler.pair(0, Dimension::kBounce);
      cells.emplace(static_cast<int>(4 * u.x), static_cast<int>(4 * u.y));
    }
    CHECK(cells.size() == 16);
  }
}

TEST_CASE("numbers differ between seeds, pixels, samples and dimensions, and are uniform") {
  const SampleLayout layout(1, 65536, 65536, 65536), other(2, 65536, 65536, 65536);
  const PixelSampler sampler(layout, 40000, 65535);
  CHECK(sampler.pair(9, Dimension::kSun) == PixelSampler(layout, 40000, 65535).pair(9, Dimension::kSun));
  CHECK(sampler.pair(9, Dimension::kSun) != PixelSampler(other, 40000, 65535).pair(9, Dimension::kSun));
  CHECK(sampler.pair(9, Dimension::kSun) != PixelSampler(layout, 65535, 40000).pair(9, Dimension::kSun));
  CHECK(sampler.pair(9, Dimension::kSun) != sampler.pair(65535, Dimension::kSun));
  CHECK(sampler.pair(9, Dimension::kSun) != sampler.pair(9, Dimension::kBounceSun));

  // Over many seeds one number is uniform, and the two of a pair, and those of two dimensions, are not correlated.
  const int count = 20000;
  double sum = 0, squares = 0, pair = 0, dimensions = 0;
  for (int seed = 0; seed < count; ++seed) {
    const PixelSampler s(SampleLayout(static_cast<std::uint64_t>(seed), 100, 100, 9), 31, 17);
    const glm::dvec2 u = s.pair(3, Dimension::kPixel), v = s.pair(3, Dimension::kSun);
    sum += u.x;
    squares += u.x * u.x;
    pair += (u.x - 0.5) * (u.y - 0.5);
    dimensions += (u.x - 0.5) * (v.x - 0.5);
  }
  const double root = std::sqrt(count);
  CHECK(std::abs(sum / count - 0.5) < 5 * std::sqrt(1.0 / 12) / root);
  CHECK(std::abs(squares / count - 1.0 / 3) < 5 * std::sqrt(4.0 / 45) / root);
  CHECK(std::abs(pair / count) < 5.0 / 12 / root);
  CHECK(std::abs(dimensions / count) < 5.0 / 12 / root);
}
