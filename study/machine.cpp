#include "study/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "base/machine_memory.h"
#include "base/version.h"
#include "study/commit.h"

namespace barkridge {

std::vector<std::pair<std::string, std::string>> machine_facts() {
  return {{"processor", value_in("/proc/cpuinfo", "model name")},
          {"cores", fmt::format("{}", std::max(1u, std::thread::hardware_concurrency()))},
          {"memory", fmt::format("{:.0f} GiB", static_cast<double>(machine_memory()) / (1u << 30))},
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
