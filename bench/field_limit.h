#pragma once
// What the machine can do: tapered capsules at points, every pair, and nothing else. No model, no pruning, no promise
// about bits; single precision, fused where the instruction set fuses, one true division a pair.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "blobtree/tree.h"

namespace barkridge::bench {

/// A cone whose nearest sphere is taken where the point projects onto the axis.
struct LimitCone {
  explicit LimitCone(const Cone& cone);

  float base[3];     ///< the axis' start
  float axis[3];     ///< from base to tip
  float along[3];    ///< axis / |axis|^2
  float base_along;  ///< dot(base, along)
  float reach;       ///< radius of influence at the base
  float widening;    ///< what it grows by towards the tip
};

/// Columns of single precision, whose size is a multiple of 64.
struct LimitColumns {
  std::vector<float> x, y, z, f, gx, gy, gz;

  explicit LimitColumns(std::span<const Vec3> points);
  std::size_t size() const { return x.size(); }
};

/// Ways to write the loop; which one is best depends on registers and latencies.
enum class LimitLoop { kTwoVectors, kFourVectors };

/// Sum of the cones' fields at all points: f; and with gradients gx, gy, gz. For the instruction set that is chosen
/// now.
void limit_values(std::span<const LimitCone> cones, LimitColumns& columns, LimitLoop loop);
void limit_values_and_gradients(std::span<const LimitCone> cones, LimitColumns& columns, LimitLoop loop);

/// The instruction sets that this machine has and the program was compiled for, as Highway numbers them, narrow first.
std::vector<std::int64_t> instruction_sets();
/// Makes one of them, or with 0 the best, what everything in this process runs on.
void choose_instruction_set(std::int64_t target);
/// Numbers of single precision in a vector of the chosen set.
std::size_t vector_width();

}  // namespace barkridge::bench
