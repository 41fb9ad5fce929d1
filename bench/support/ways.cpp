#include "bench/support/ways.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/machine_memory.h"
#include "bench/support/machine.h"

namespace barkridge::bench {

namespace {

constexpr const char* kSelf = "/proc/self/exe";
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t size = ::read(descriptor, buffer.data(), buffer.size());
    if (size <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
}

pid_t start_self(const std::vector<std::string>& arguments, int output) {
  std::vector<std::string> words{kSelf};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, kSelf, &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot run this program again");
  return child;
}

std::optional<Numbers> run_self(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t child = start_self(arguments, ends[1]);
  ::close(ends[1]);
  const std::string text = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (status != 0) return std::nullopt;
  return nlohmann::json::parse(text).get<Numbers>();
}

void run_way(Way& way) {
  fmt::print(stderr, "{}, {}, {} threads: ", way.model, way.surface, way.threads);
  const std::optional<Numbers> run = run_self(way.arguments);
  if (!run) {
    way.numbers.clear();
    fmt::print(stderr, "failed\n");
    return;
  }
  for (const auto& [name, value] : *run) way.numbers[name].values.push_back(value);
  fmt::print(stderr, "{:.3f} s\n", run->at("total"));
}

const Way* counterpart(const std::vector<Way>& ways, const Way& way, const std::string& surface) {
  const auto found = std::find_if(ways.begin(), ways.end(), [&](const Way& other) {
    return other.model == way.model && other.threads == way.threads && other.surface == surface;
  });
  return found == ways.end() ? nullptr : &*found;
}

double ratio(const Way& a, const Way& b, const std::string& name) {
  return a.numbers.empty() || b.numbers.empty() ? kNothing : paired_ratio(a.numbers.at(name), b.numbers.at(name));
}

// The larger one, NaN if either is.
double worse(double a, double b) { return std::isnan(a) || std::isnan(b) ? kNothing : std::max(a, b); }

}  // namespace

double Way::median(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? kNothing : found->second.median();
}

void run_in_turns(std::vector<Way>& ways, int turns) {
  for (int turn = 0; turn < turns; ++turn) {
    for (Way& way : ways) {
      if (turn == 0 || !way.numbers.empty()) run_way(way);
    }
  }
}

void run_once(int limit, const std::function<Numbers()>& work) {
  constexpr double kLong = 0.5;  // seconds; longer work is not repeated
  constexpr double kEnough = 1.0;
  constexpr int kFewest = 3, kMost = 30;
  const rlim_t memory = static_cast<rlim_t>(0.8 * static_cast<double>(machine_memory()));
  const rlimit bound{memory, memory};
  ::setrlimit(RLIMIT_AS, &bound);
  ::alarm(static_cast<unsigned>(limit));

  reset_peak_memory();
  Numbers result = work();
  const double peak = static_cast<double>(peak_memory());
  if (result.at("total") < kLong) {
    std::map<std::string, Samples> warm;
    const Stopwatch watch;
    for (int i = 0; i < kMost && (i < kFewest || watch.seconds() < kEnough); ++i) {
      for (const auto& [name, value] : work()) warm[name].values.push_back(value);
    }
    for (const auto& [name, samples] : warm) result[name] = samples.median();
  }
  result["peak"] = peak;
  fmt::print("{}\n", nlohmann::json(result).dump());
}

void add_surface_ratios(Study& study, const std::vector<Way>& ways, const std::string& name,
                        const std::string& prefix) {
  Table table{.title = fmt::format("Surfaces against each other, {} time", name),
              .columns = {"model", "threads", "surfaces", "ratio"},
              .rows = {},
              .notes = {}};
  for (const auto& [surface, to] : {std::pair("ridge", "smooth"), std::pair("bend", "ridge")}) {
    double worst = 0;
    for (const Way& way : ways) {
      const Way* other = way.surface == surface ? counterpart(ways, way, to) : nullptr;
      if (!other) continue;
      const double factor = ratio(way, *other, name);
      worst = worse(worst, factor);
      table.rows.push_back({way.model, way.threads, fmt::format("{}/{}", surface, to), factor});
    }
    if (worst != 0) study.figure(fmt::format("{}_{}_to_{}", prefix, surface, to), worst);
  }
  study.add(std::move(table));
}

}  // namespace barkridge::bench
