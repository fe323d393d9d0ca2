// Files that are written whole or not at all. Links, modes, pipes and programs
// that are ended are in tests/command_line/test_output_files.py.

#include <doctest/doctest.h>

#include <string>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "common/files/read_file.hpp"
#include "common/files/write_file.hpp"
#include "common/scene_file/message_text.hpp"
#include "tests/core/full_disk.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
namespace fs = std::filesystem;

namespace {

/// Why a file could not be written; "" if it could.
std::string complaint(const std::string& path, const std::string& bytes) {
  try {
    write_file(path, bytes);
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a file has just the bytes that were given, and nothing is left") {
  const TemporaryFolder folder;
  const std::string all_values("\0\n\r\x1a\xff text", 10);
  for (const std::string& bytes :
       {std::string(), all_values, std::string(3'000'000, 'x')}) {
    CHECK(complaint(folder / "a", bytes) == "");
    const bool same = bytes_of(folder / "a") == bytes;
    CHECK(same);
    CHECK(folder.entries() == 1);
  }
}

TEST_CASE("a file cannot be written where a folder is, or none") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a");
  CHECK(complaint(folder / "a", "bytes") == "it is a folder");
  CHECK(complaint(folder / "b/c", "bytes") ==
        "there is no folder '" + (folder / "b") + "'");
  CHECK(folder.entries() == 1);
}

TEST_CASE("two writers of one file each have a temporary file of their own") {
  const TemporaryFolder folder;
  store(folder / "a", "old");
  const FilePlace place = find_file_place(folder / "a");
  UnfinishedFile first(place), second(place);
  CHECK(folder.entries() == 3);
  second.finish("second");
  CHECK(bytes_of(folder / "a") == "second");
  first.finish("first");
  CHECK(bytes_of(folder / "a") == "first");
  CHECK(folder.entries() == 1);
}

TEST_CASE("names beyond ASCII are names of files, written and read") {
  const TemporaryFolder folder;
  const std::string name = folder / "caf\xc3\xa9 \xe2\x9c\x93.bin";
  CHECK(complaint(name, "bytes") == "");
  CHECK(fs::exists(file_path(name)));
  CHECK(name_of(file_path(name)) == name);
  CHECK(read_file(name, 3) == "byt");
}

TEST_CASE("a place that can be written passes the check, without a trace") {
  const TemporaryFolder folder;
  check_file_place(folder / "a");
  CHECK(folder.entries() == 0);
  store(folder / "a", "bytes");
  check_file_place(folder / "a");
  CHECK(bytes_of(folder / "a") == "bytes");
  CHECK(folder.entries() == 1);
  CHECK_THROWS_AS(check_file_place(folder / "none/a"), FileError);
  CHECK_THROWS_AS(check_file_place(folder / std::string(300, 'x')),
                  FileError);
}

#ifndef _WIN32
// A simulated full disk: no file may grow beyond some bytes. With one byte too
// few, the very last write fails; for a small file this is the only write, when
// the file is closed.
TEST_CASE("a full disk leaves the old file and nothing unfinished") {
  const TemporaryFolder folder;
  store(folder / "a", "the old file");
  for (const std::size_t size : {20, 1'000'000}) {
    const std::string bytes(size, 'x');
    for (const std::size_t room :
         {std::size_t{0}, std::size_t{1}, size / 2, size - 1}) {
      std::string why;
      {
        const FullDisk full(room);
        why = complaint(folder / "a", bytes);
      }
      CAPTURE(room);
      CHECK(why == "it cannot be written whole; is there room?");
      CHECK(bytes_of(folder / "a") == "the old file");
      CHECK(folder.entries() == 1);
    }
  }
  const FullDisk just_enough(20);
  CHECK(complaint(folder / "a", std::string(20, 'x')) == "");
}

// A separate program is killed in the middle of a write: by the signal for too
// long a file, which comes at a known byte. kill -9 would do the same.
TEST_CASE("a program that is killed while it writes leaves the old file") {
  const TemporaryFolder folder;
  store(folder / "a", "the old file");
  const pid_t child = fork();
  if (child == 0) {
    const FullDisk full(1000);
    signal(SIGXFSZ, SIG_DFL);
    complaint(folder / "a", std::string(3000, 'x'));
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
  CHECK(bytes_of(folder / "a") == "the old file");
  CHECK(folder.entries() == 2);  // and a part of the new one, .unfinished-...
}
#endif

TEST_CASE("control characters of names are escaped, and nothing else") {
  CHECK(escaped("a.exr") == "a.exr");
  CHECK(escaped("\n\x1b[2J\x7f") == "\\x0a\\x1b[2J\\x7f");
  CHECK(escaped("\xc2\x9b") == "\\xc2\\x9b");                // ESC [ in one
  CHECK(escaped("\xc2\xa0\xc3\x9b") == "\xc2\xa0\xc3\x9b");  // no-break, Û
  CHECK(escaped("\x9b\xc2") == "\x9b\xc2");
}
