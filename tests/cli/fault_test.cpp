#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "base/machine_memory.h"
#include "tests/cli/run_program.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge::test;
using barkridge::read_file;
using Catch::Matchers::Contains;

namespace {

const char* const kBall = "model.tree = 'cone(tip = 0 0 0)'\n";

RunOptions with(std::function<void()> before_start) {
  RunOptions options;
  options.before_start = std::move(before_start);
  return options;
}

void redirect_output_to(const char* path) { ::dup2(::open(path, O_WRONLY), 1); }

// Waits until `condition` holds, for ten seconds at the most.
template <typename Condition>
bool eventually(Condition condition) {
  for (int i = 0; i < 10000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

// Whether the process has become the program and come to the point where it catches the signal.
bool catches(int process, int signal) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  bool is_program = false;
  for (std::string line; std::getline(status, line);) {
    if (line == "Name:\tbarkridge") is_program = true;
    if (line.starts_with("SigCgt:"))
      return is_program && (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  return false;
}

}  // namespace

TEST_CASE("results that cannot be written are a failure, whatever the verb") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.skel", "# barkridge skeleton 1\n0 -1 0 0 0 0 1 0 0.1 0.1\n");
  const std::string points = folder.write("points.txt", "0 0 0\n");
  const std::string lsystem = folder.write("a.l", "Lsystem: 1\nderivation length: 0\naxiom: F\nF --> F\nendlsystem\n");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"grow", lsystem},
                                             {"skeleton", scene},
                                             {"field", scene, "--points", points},
                                             {"info", scene},
                                             {"--help"},
                                             {"--version"}}) {
    CAPTURE(arguments[0]);
    const Finished full = run_program(arguments, with([] { redirect_output_to("/dev/full"); }));
    CHECK(full.status == 1);
    CHECK_THAT(full.err, Contains("barkridge: standard output: No space left on device"));
  }
  const Finished closed = run_program({"skeleton", scene}, with([] { ::close(1); }));
  CHECK(closed.status == 1);
  CHECK_THAT(closed.err, Contains("barkridge: standard output: "));
}

TEST_CASE("a reader that goes away ends the program without a word") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kBall);
  const Finished finished = run_program({"info", scene}, with([] {
                                          int ends[2];
                                          if (::pipe(ends) != 0) ::_exit(126);
                                          ::close(ends[0]);
                                          ::dup2(ends[1], 1);
                                        }));
  CHECK(finished.status == 1);
  CHECK(finished.err.empty());
}

TEST_CASE("the libraries of EXR files are not loaded before there is one to be written") {
  const Finished traced = run_program({}, with([] { ::setenv("LD_TRACE_LOADED_OBJECTS", "1", 1); }));
  CHECK_THAT(traced.out, Contains("libembree") && !Contains("OpenImageIO") && !Contains("OpenEXR"));
}

TEST_CASE("targets that cannot be written are a failure found before the work") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kBall);
  std::filesystem::create_directory(folder.path("folder.png"));
  for (const std::string& target : {folder.path("none/a.png"), folder.path("folder.png"), std::string("/proc/a.png")}) {
    // 4096 samples in a large picture would take hours.
    const Finished finished = run_program({"render", scene, "-o", target, "--size", "8192x8192", "--spp", "4096"});
    CAPTURE(target);
    CHECK(finished.status == 1);
    CHECK_THAT(finished.err, Contains(target));
  }
  CHECK(run_program({"mesh", scene, "-o", folder.path("none/a.ply"), "--cell-size", "0.0001"}).status == 1);
}

TEST_CASE("a disk that fills up is a failure that leaves the old file and nothing else") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kBall);
  const std::vector<std::vector<std::string>> runs = {
      {"render", scene, "-o", folder.write("a.exr", "old"), "--size", "64x64", "--spp", "1"},
      {"render", scene, "-o", folder.write("a.png", "old"), "--size", "64x64", "--spp", "1"},
      {"mesh", scene, "-o", folder.write("a.ply", "old"), "--cell-size", "0.1"},
      {"mesh", scene, "-o", folder.write("a.obj", "old"), "--cell-size", "0.1"},
      {"mesh", scene, "-o", folder.write("a.stl", "old"), "--cell-size", "0.1"}};
  const std::size_t entries = folder.entries();
  for (const std::vector<std::string>& arguments : runs) {
    const Finished finished = run_program(arguments, with([] {
                                            std::signal(SIGXFSZ, SIG_IGN);
                                            const rlimit limit{500, 500};
                                            ::setrlimit(RLIMIT_FSIZE, &limit);
                                          }));
    CAPTURE(arguments[3]);
    CHECK(finished.status == 1);
    CHECK_THAT(finished.err, Contains(arguments[3]));
    CHECK(read_file(arguments[3]) == "old");
    CHECK(folder.entries() == entries);
  }
}

TEST_CASE("pictures and meshes beyond the machine's memory are refused before they are begun") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kBall);
  if (barkridge::machine_memory() < 100'000'000'000) {
    const Finished picture = run_program({"render", scene, "-o", folder.path("a.png"), "--size", "65536x32768"});
    CHECK(picture.status == 1);
    CHECK_THAT(picture.err, Contains("GB of memory") && Contains("--region"));
  }
  const Finished mesh =
      run_program({"mesh", scene, "-o", folder.path("a.ply"), "--cell-size", "0.05", "-D", "mesh.max_triangles=100"});
  CHECK(mesh.status == 2);
  CHECK_THAT(mesh.err, Contains("limit of 100"));
  CHECK(folder.entries() == 1);
}

TEST_CASE("signals end the program with their status, leave the old file and no litter") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kBall);
  const std::string target = folder.write("a.png", "old");
  const std::size_t entries = folder.entries();
  for (const auto& [signal, status] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    const int process = start_program({"render", scene, "-o", target, "--size", "8192x8192", "--spp", "4096"});
    REQUIRE(eventually([process, caught = signal] { return catches(process, caught); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ::kill(process, signal);
    CHECK(wait_for(process) == status);
    CHECK(read_file(target) == "old");
    CHECK(folder.entries() == entries);
  }
}

TEST_CASE("a signal while the output is being written leaves the old file or the new one, whole, and no litter") {
  const ScratchFolder folder;
  const std::string scene = folder.write("a.toml", kBall);
  const std::string whole = folder.path("whole.obj");
  REQUIRE(run_program({"mesh", scene, "-o", whole, "--cell-size", "0.01"}).status == 0);
  const std::string target = folder.write("a.obj", "old");
  const std::size_t entries = folder.entries();
  const int process = start_program({"mesh", scene, "-o", target, "--cell-size", "0.01"});
  const auto being_written = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(target).parent_path())) {
      std::error_code gone;
      if (entry.path().string().find(".tmp-") != std::string::npos && entry.file_size(gone) > 0 && !gone) return true;
    }
    return false;
  };
  CHECK(eventually(being_written));
  ::kill(process, SIGTERM);
  if (const int status = wait_for(process); status != 0) {
    CHECK(status == 143);
    CHECK(read_file(target) == "old");
  } else {
    CHECK(read_file(target) == read_file(whole));
  }
  CHECK(folder.entries() == entries);
}
