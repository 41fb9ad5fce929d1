#include "cli/work_statistics.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "base/output_file.h"

namespace barkridge::cli {

std::size_t peak_resident_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void WorkStatistics::write(const std::string& path) const {
  const nlohmann::ordered_json values = {{"internodes", internodes},
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
