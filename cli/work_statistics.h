#pragma once
// What making a mesh took, for those who compare.

#include <chrono>
#include <cstddef>
#include <string>

namespace barkridge::cli {

/// Most memory that this process has held so far.
std::size_t peak_resident_bytes();

/// Seconds from reading the scene to the skeleton, from there to a compiled field or a control mesh, and from there to
/// triangles; writing files does not count. Limbs that cross are those of `crossing_limbs` in the skeleton.
struct WorkStatistics {
  std::size_t internodes = 0, crossing_limbs = 0, control_triangles = 0, triangles = 0;
  double skeleton_seconds = 0, build_seconds = 0, surface_seconds = 0;

  /// As one JSON object, with the peak of memory, whole or not at all. Throws `IoError`.
  void write(const std::string& path) const;
};

/// Seconds since it was made or last asked.
class StageClock {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace barkridge::cli
