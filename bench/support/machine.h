#pragma once
// The machine under the measurement, and this process's memory on it.

#include <cstddef>
#include <nlohmann/json.hpp>

namespace barkridge::bench {

/// Those of the study (study/machine.h), instruction sets, and how busy the machine is now.
nlohmann::ordered_json machine_facts();

int core_count();

/// Bytes of this process that are in memory now, and the most that ever were.
std::size_t resident_memory();
std::size_t peak_memory();

inline double megabytes(std::size_t bytes) { return static_cast<double>(bytes) / 1e6; }

/// Gives back what is free and forgets the peak so far.
void reset_peak_memory();
/// Gives back what is free, so that two readings of `resident_memory` differ by what was kept.
void release_free_memory();

}  // namespace barkridge::bench
