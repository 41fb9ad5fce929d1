#include "cli/work_statistics.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/output_file.h"
#include "study/machine.h"

namespace barkridge::cli {

std::size_t peak_resident_bytes() {
  // Not getrusage's: that begins with what the program which started this one held.
  return 1024 * std::strtoull(value_in("/proc/self/status", "VmHWM").c_str(), nullptr, 10);
}

void WorkStatistics::write(const std::string& path) const {
  const nlohmann::ordered_json values = {{"internodes", internodes},
                                         {"crossing_limbs", crossing_limbs},
                                         {"control_triangles", control_triangles},
                                         {"triangles", triangles},
                                         {"skeleton_seconds", skeleton_seconds},
                                         {"build_seconds", build_seconds},
                                         {"surface_seconds", surface_seconds},
                                         {"peak_bytes", peak_resident_bytes()}};
  OutputFile file(path);
  file.write(values.dump(2) + '\n');
  file.commit();
}

}  // namespace barkridge::cli
