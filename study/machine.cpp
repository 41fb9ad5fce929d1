#include "study/machine.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "base/version.h"
#include "study/commit.h"

namespace barkridge {

std::vector<std::pair<std::string, std::string>> machine_facts() {
  const double bytes = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return {{"processor", value_in("/proc/cpuinfo", "model name")},
          {"cores", fmt::format("{}", std::max(1u, std::thread::hardware_concurrency()))},
          {"memory", fmt::format("{:.0f} GiB", bytes / (1u << 30))},
          {"compiler", "g++ " __VERSION__},
          {"version", version()},
          {"commit", BARKRIDGE_COMMIT}};
}

std::string value_in(const char* file, const std::string& key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t start = line.find_first_not_of(": \t", key.size());
    return start == std::string::npos ? "" : line.substr(start);
  }
  return "";
}

}  // namespace barkridge
