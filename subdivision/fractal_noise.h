#pragma once
// Bark as fractal noise: vertices are moved between the steps of subdivision, so that every step adds finer bumps.

#include <cstdint>

#include "subdivision/control_mesh.h"
#include "subdivision/loop.h"

namespace barkridge {

/// After step `i`, from 1 on, each vertex is moved along its normal by a normally distributed random number with the
/// standard deviation `amplitude lacunarity^(-i hurst) Bias(t)` [Mac04, section 6.5; Miller86]. `t` is the vertex's age
/// over the oldest one's, 1 where ages are not known or all 0; `Bias(t) = t^(log(bias) / log(1/2))` is Perlin's.
struct FractalNoise {
  double amplitude = 0;   ///< in scene units, >= 0; some hundredths of a trunk's radius look like bark
  double lacunarity = 2;  ///< ratio of a step's frequency to the one's before, > 1; subdivision halves edges
  double hurst = 0.8;     ///< H, in [0, 1]: 0 is as rough at every scale, 1 nearly smooth
  double bias = 0.5;      ///< in (0, 1]: 1/2 has noise fall in proportion to age, less spares the young more, 1 no one
  std::uint64_t seed = 0;
};

/// As `subdivide`, with noise after each of the steps. Coarse vertices are not moved before the first. Normals are
/// those of `to_mesh`. What moves a vertex depends on seed, step and its number only, which later steps keep, so a mesh
/// of more levels is rough where one of fewer is. Noise may make the surface meet itself where its amplitude nears the
/// radius of a twig.
///
/// Throws as `subdivide`, and `InputError` for noise out of range.
ControlMesh subdivide_with_noise(const ControlMesh& mesh, int levels, const FractalNoise& noise,
                                 const LoopOptions& options = {});

}  // namespace barkridge
