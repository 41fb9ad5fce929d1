#pragma once
// What the study finds out about one method at one resolution, and what follows from many of them.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace barkridge {

/// Repeated times of one thing, in seconds.
struct Times {
  double median = 0, least = 0, most = 0;
};
/// Of any number of repetitions; zeros for none.
Times times_of(std::vector<double> seconds);

/// How far a surface is from one ten times finer of the same method, two-sided, in pixels of a picture that shows the
/// whole model: the largest distance, and the root of the mean square.
struct PixelError {
  double largest = 0, root_mean_square = 0;
};

struct Measurement {
  std::string model, method, setting;
  std::size_t internodes = 0, triangles = 0, peak_bytes = 0;
  /// Pairs of limbs of the skeleton that cross, so that separate skins must.
  std::size_t crossing_limbs = 0;
  /// From text to skeleton; from there to a compiled field or a control mesh; from there to triangles; and all three.
  Times skeleton, build, surface, total;
  std::optional<PixelError> error;
  double pixel = 0;  ///< its width in the model's unit
  /// Pairs of triangles that cross, where they were counted.
  std::optional<std::size_t> crossings;

  /// Of the surface's own time, building included, as the thesis counts; 0 where no time was taken.
  double triangles_per_second() const;
};

/// Two settings have equal quality when both are within this root mean square of their own surface. The largest error
/// would compare single points: a crease that no lattice resolves keeps it near a cell at any resolution.
inline constexpr double kEqualQualityPixels = 0.5;

inline constexpr const char* kImplicitMethod = "implicit";
/// Separate cylinders make no joints: they show what these cost, and are no rival.
inline constexpr const char* kBaselineMethod = "cylinders";

/// Of a model, the cheapest setting of the implicit method and of all others but the baseline that are within
/// `kEqualQualityPixels`, by building and surface; null where there is none.
struct Headline {
  std::string model;
  const Measurement* implicit = nullptr;
  const Measurement* subdivision = nullptr;

  /// How many times longer the implicit surface takes, if there are both.
  std::optional<double> ratio() const;
};
/// One for each model, in their order. They point into `measurements`.
std::vector<Headline> headlines(std::span<const Measurement> measurements);

}  // namespace barkridge
