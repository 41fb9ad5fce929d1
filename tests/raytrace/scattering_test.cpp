#include "raytrace/scattering.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "raytrace/sampler.h"

using namespace barkridge;

namespace {

Vec3 direction(double cosine, double turn) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

// Reflected share of light from `view`'s side, by the midpoint rule over the hemisphere.
Color reflected(const Scattering& scattering, const Vec3& view) {
  const int rings = 600, steps = 600;
  Color sum(0);
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < steps; ++j) {
      sum += scattering.evaluate({0, 0, 1}, view, direction((i + 0.5) / rings, 2 * M_PI * (j + 0.5) / steps));
    }
  }
  return sum * (2 * M_PI / (rings * steps));
}

}  // namespace

TEST_CASE("without its lobe a surface reflects its colour") {
  const Scattering scattering(Material{{0.8, 0.5, 0.1}, 0, 0.5});
  CHECK(glm::length(reflected(scattering, direction(0.6, 0)) - Color(0.8, 0.5, 0.1)) < 1e-4);
}

TEST_CASE("no surface reflects more than it receives") {
  for (const double roughness : {0.3, 0.6, 1.0}) {
    for (const double specular : {0.04, 0.5, 1.0}) {
      for (const double cosine : {0.2, 0.6, 1.0}) {
        const Scattering scattering(Material{Color(1), specular, roughness});
        // Grazing Fresnel reflection comes on top of a constant diffuse part, hence a few per cent.
        CHECK(reflected(scattering, direction(cosine, 1)).x < (cosine < 0.5 ? 1.25 : 1.05));
      }
    }
  }
}

TEST_CASE("scattering is the same with light and view exchanged") {
  const Scattering scattering(Material{{0.8, 0.5, 0.1}, 0.3, 0.4});
  const Vec3 a = direction(0.3, 0.1), b = direction(0.8, 2), n(0, 0, 1);
  CHECK(glm::length(scattering.evaluate(n, a, b) / b.z - scattering.evaluate(n, b, a) / a.z) < 1e-12);
}

TEST_CASE("sampled directions estimate the reflected share") {
  for (const double roughness : {0.3, 0.6, 1.0}) {
    for (const double specular : {0.0, 0.04, 1.0}) {
      for (const double cosine : {0.3, 0.9}) {
        const Scattering scattering(Material{{0.5, 0.2, 0.0}, specular, roughness});
        const Vec3 view = direction(cosine, 0.7);
        const int count = 1 << 16;
        const PixelSampler sampler(SampleLayout(1, 1, 1, count), 0, 0);
        Color sum(0);
        for (int i = 0; i < count; ++i) {
          const auto s = scattering.sample({0, 0, 1}, view, sampler.pair(i, Dimension::kBounce),
                                           sampler.pair(i, Dimension::kLobe).x);
          if (s) sum += s->weight;
        }
        const Color expected = reflected(scattering, view);
        INFO(roughness << " " << specular << " " << cosine << ": " << sum.x / count << " and " << expected.x);
        CHECK(glm::length(sum / static_cast<double>(count) - expected) < 5e-3);
      }
    }
  }
}

TEST_CASE("nothing is scattered from or to below the surface") {
  const Scattering scattering(Material{Color(1), 0.5, 0.5});
  CHECK(scattering.evaluate({0, 0, 1}, {0, 0, 1}, {0, 0, -1}) == Color(0));
  CHECK(scattering.evaluate({0, 0, 1}, {0, 0, -1}, {0, 0, 1}) == Color(0));
  CHECK_FALSE(scattering.sample({0, 0, 1}, {0, 0, -1}, {0.5, 0.5}, 0.5));
}
