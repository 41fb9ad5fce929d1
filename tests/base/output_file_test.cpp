#include "base/output_file.h"

#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>

#include "base/error.h"

using namespace barkridge;
namespace fs = std::filesystem;

namespace {

// A directory of its own for a test, gone afterwards.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("barkridge-base-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

// Makes every write past `bytes` fail with EFBIG, as a full disk would with ENOSPC.
struct FileSizeLimit {
  rlimit old{};
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old);
    const rlimit limit{bytes, old.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &old); }
};

}  // namespace

TEST_CASE("an output appears only when committed") {
  const Folder folder;
  const std::string path = (folder.path / "a.txt").string();
  {
    OutputFile file(path);
    file.write("lost");
    CHECK_FALSE(fs::exists(path));
  }
  CHECK(folder.entries() == 0);
  OutputFile file(path);
  file.write("hello world");
  file.seek(6);
  file.write("there");
  file.commit();
  CHECK(read_file(path) == "hello there");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a failed output leaves the old file and no litter") {
  const Folder folder;
  const std::string path = (folder.path / "a.bin").string();
  {
    OutputFile file(path);
    file.write("old");
    file.commit();
  }
  const FileSizeLimit limit(1 << 16);
  OutputFile file(path);
  file.write(std::string(1 << 22, 'x'));
  CHECK(file.failed());
  CHECK_THROWS_AS(file.commit(), IoError);
  CHECK(read_file(path) == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("targets that cannot be written are refused at once") {
  const Folder folder;
  CHECK_THROWS_AS(OutputFile((folder.path / "no" / "such.txt").string()), IoError);
  CHECK_THROWS_AS(OutputFile(folder.path.string()), IoError);
}

TEST_CASE("a signal handler can remove unfinished outputs") {
  const Folder folder;
  OutputFile file((folder.path / "a.txt").string());
  CHECK(folder.entries() == 1);
  remove_unfinished_outputs();
  CHECK(folder.entries() == 0);
}

TEST_CASE("reading reports missing files and stops at its limit") {
  const Folder folder;
  const std::string path = (folder.path / "a.txt").string();
  CHECK_THROWS_AS(read_file(path), IoError);
  OutputFile file(path);
  file.write("12345");
  file.commit();
  CHECK_THROWS_AS(read_file(path, 4), LimitError);
  CHECK(read_file(path, 5) == "12345");
}
