#include "bench/support/machine.h"

#include <hwy/highway.h>
#include <malloc.h>
#include <stdlib.h>

#include <fstream>
#include <string>
#include <thread>

#include "study/machine.h"

namespace barkridge::bench {

namespace {

std::size_t kilobytes_in_status(const std::string& key) {
  const std::string value = value_in("/proc/self/status", key);
  return value.empty() ? 0 : 1024 * std::stoull(value);
}

// Of the last minute: processes that wanted to run.
double load_average() {
  double load = 0;
  return ::getloadavg(&load, 1) == 1 ? load : 0.0;
}

std::string instruction_sets() {
  std::string names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (target == HWY_SCALAR || target == HWY_EMU128) continue;
    names = hwy::TargetName(target) + (names.empty() ? "" : " " + names);
  }
  return names;
}

}  // namespace

nlohmann::ordered_json machine_facts() {
  nlohmann::ordered_json facts;
  for (const auto& [name, value] : barkridge::machine_facts()) facts[name] = value;
  facts["instruction sets"] = instruction_sets();
  facts["load"] = load_average();
  return facts;
}

int core_count() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

std::size_t resident_memory() { return kilobytes_in_status("VmRSS"); }
std::size_t peak_memory() { return kilobytes_in_status("VmHWM"); }

void reset_peak_memory() {
  release_free_memory();
  std::ofstream("/proc/self/clear_refs") << "5";
}

void release_free_memory() { ::malloc_trim(0); }

}  // namespace barkridge::bench
