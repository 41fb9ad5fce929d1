#include "base/output_file.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "base/error.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;
namespace fs = std::filesystem;

namespace {}  // namespace

TEST_CASE("an output appears only when committed") {
  const ScratchFolder folder;
  const std::string path = folder.path("a.txt");
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
  const ScratchFolder folder;
  const std::string path = folder.path("a.bin");
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
  const ScratchFolder folder;
  CHECK_THROWS_AS(OutputFile(folder.path("no/such.txt")), IoError);
  CHECK_THROWS_AS(OutputFile(folder.path("")), IoError);
}

TEST_CASE("a signal handler can remove unfinished outputs") {
  const ScratchFolder folder;
  OutputFile file(folder.path("a.txt"));
  CHECK(folder.entries() == 1);
  remove_unfinished_outputs();
  CHECK(folder.entries() == 0);
}

TEST_CASE("reading reports missing files and stops at its limit") {
  const ScratchFolder folder;
  const std::string path = folder.path("a.txt");
  CHECK_THROWS_AS(read_file(path), IoError);
  OutputFile file(path);
  file.write("12345");
  file.commit();
  CHECK_THROWS_AS(read_file(path, 4), LimitError);
  CHECK(read_file(path, 5) == "12345");
}
