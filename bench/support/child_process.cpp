#include "bench/support/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/support/machine.h"

namespace barkridge::bench {

namespace {

constexpr const char* kSelf = "/proc/self/exe";
constexpr double kLong = 0.5;  // seconds; work as long as this is not repeated
constexpr double kEnough = 1.0;
constexpr int kMostRepetitions = 30;

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

}  // namespace

Numbers run_self(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t child = start_self(arguments, ends[1]);
  ::close(ends[1]);
  const std::string text = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (status != 0) throw std::runtime_error(fmt::format("the run `{}` failed", fmt::join(arguments, " ")));
  return nlohmann::json::parse(text).get<Numbers>();
}

void run_in_turns(std::vector<ChildRuns>& ways, int turns, const std::function<void(const ChildRuns&)>& done) {
  for (int turn = 0; turn < turns; ++turn) {
    for (ChildRuns& way : ways) {
      const Numbers run = run_self(way.arguments);
      for (const auto& [name, value] : run) way.numbers[name].values.push_back(value);
      done(way);
    }
  }
}

void measure_in_child(const std::function<Numbers()>& work) {
  reset_peak_memory();
  Numbers result = work();
  const double peak = static_cast<double>(peak_memory());
  if (result.at("total") < kLong) {
    std::map<std::string, Samples> warm;
    const Stopwatch watch;
    for (int i = 0; i < kMostRepetitions && (i < 3 || watch.seconds() < kEnough); ++i) {
      for (const auto& [name, value] : work()) warm[name].values.push_back(value);
    }
    for (const auto& [name, samples] : warm) result[name] = samples.median();
  }
  result["peak"] = peak;
  fmt::print("{}\n", nlohmann::json(result).dump());
}

}  // namespace barkridge::bench
