// Files that are written whole or not at all. What happens when the system
// fails in the middle is in tests/command_line/test_faults.py.

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "common/image/write_file.hpp"
#include "common/scene_file/message_text.hpp"
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
  } catch (const ImageError& error) {
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
  CHECK(complaint(folder / "a", "bytes") != "");
  CHECK(complaint(folder / "b/c", "bytes") ==
        "there is no folder '" + (folder / "b") + "'");
  CHECK(folder.entries() == 1);
}

TEST_CASE("unfinished files have another name each time, beside the target") {
  std::set<std::string> names;
  for (int i = 0; i < 1000; ++i) {
    names.insert(unfinished_name("folder/" + std::string(250, 'x') + ".exr"));
  }
  CHECK(names.size() == 1000);
  for (const fs::path name : names) {
    CHECK(name.parent_path() == "folder");
    CHECK(name.filename().string().size() < 40);
  }
  CHECK(fs::path(unfinished_name("a.exr")).parent_path().empty());
}

TEST_CASE("an unfinished file is known until it is renamed or removed") {
  const TemporaryFolder folder;
  CHECK(complaint(folder / "a", "bytes") == "");
  const bool none_after_success = unfinished_file.load() == nullptr;
  CHECK(none_after_success);
  CHECK(complaint(folder / std::string(300, 'x'), "bytes") != "");
  const bool none_after_failure = unfinished_file.load() == nullptr;
  CHECK(none_after_failure);
}

TEST_CASE("a place that can be written passes the check, without a trace") {
  const TemporaryFolder folder;
  check_place(folder / "a");
  CHECK(folder.entries() == 0);
  store(folder / "a", "bytes");
  check_place(folder / "a");
  CHECK(bytes_of(folder / "a") == "bytes");
  CHECK(folder.entries() == 1);
  CHECK_THROWS_AS(check_place(folder / "none/a"), ImageError);
  CHECK_THROWS_AS(check_place(folder / std::string(300, 'x')), ImageError);
}

#ifndef _WIN32
TEST_CASE("only names of open files are taken for them") {
  CHECK(descriptor_in("/dev/fd/0") == 0);
  CHECK(descriptor_in("/proc/self/fd/12") == 12);
  for (const char* other :
       {"", "/dev/fd/", "/dev/fd/1x", "/dev/fd/-1", "/dev/fd/9999999",
        "/dev/fd/../1", "/dev/stdout", "dev/fd/1", "1"}) {
    CAPTURE(other);
    CHECK(descriptor_in(other) == -1);
  }
}
#endif

TEST_CASE("control characters of names are spelt out, and nothing else") {
  CHECK(escaped("a.exr") == "a.exr");
  CHECK(escaped("\n\x1b[2J\x7f") == "\\x0a\\x1b[2J\\x7f");
  CHECK(escaped("\xc2\x9b") == "\\xc2\\x9b");                // ESC [ in one
  CHECK(escaped("\xc2\xa0\xc3\x9b") == "\xc2\xa0\xc3\x9b");  // no-break, Û
  CHECK(escaped("\x9b\xc2") == "\x9b\xc2");
}
