// What goes wrong with files: broken ones, missing folders, full disks.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image_file.hpp"
#include "tests/core/full_disk.hpp"
#include "tests/core/largest_allocation.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
namespace fs = std::filesystem;

TEST_CASE("files that are empty, cut off or text are refused with a reason") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
    CAPTURE(ending);
    write_image(folder / ("good" + ending), picture(), {});
    const std::string good = bytes_of(folder / ("good" + ending));
    const std::string path = folder / ("broken" + ending);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{4}, good.size() / 4,
          good.size() / 2, good.size() * 3 / 4}) {
      store(path, good.substr(0, size));
      CAPTURE(size);
      CHECK(read_complaint(path) != "");
    }
    store(path, "This is not an image, whatever its name says.\n");
    CHECK(read_complaint(path) != "");
  }
  CHECK(read_complaint(folder / "none.exr") == "there is no such file");
  fs::create_directory(folder / "folder.exr");
  CHECK(read_complaint(folder / "folder.exr") == "it is not a file");
  store(folder / "a.gif", "GIF89a");
  CHECK(read_complaint(folder / "a.gif") ==
        "its name ends in none of .exr, .png, .pfm, .ppm");
}

// The data window, made a million pixels wide and high.
TEST_CASE("an EXR header that claims too much is refused, not allocated") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.exr";
  write_image(path, picture(), {});
  std::string bytes = bytes_of(path);
  for (const std::string name : {"dataWindow", "displayWindow"}) {
    const std::size_t at = bytes.find(name + '\0' + "box2i");
    REQUIRE(at != std::string::npos);
    const std::size_t corner = at + name.size() + 1 + 6 + 4 + 8;
    bytes.replace(corner, 8, std::string("\x3f\x42\x0f\0\x3f\x42\x0f\0", 8));
  }
  store(path, bytes);
  largest_allocation = 0;
  CHECK(read_complaint(path) != "");
  CHECK(largest_allocation < 100'000'000);
}

#ifndef _WIN32
// A full disk, simulated: no file may grow beyond some bytes. With one byte
// too few it is the very last write that fails, which libraries like to miss,
// and of a small file it is the only one.
TEST_CASE("a full disk leaves the old image and nothing unfinished") {
  const TemporaryFolder folder;
  for (const int size : {4, 60}) {
    const RenderResult result = picture(size, size);
    for (const std::string ending : endings) {
      const std::string path = folder / ("a" + ending);
      write_image(path, result, {});
      const std::string whole = bytes_of(path);
      store(path, "the old image");
      const std::ptrdiff_t files = folder.entries();
      for (const std::size_t room : {std::size_t{0}, std::size_t{10},
                                     whole.size() / 2, whole.size() - 1}) {
        std::string why;
        {
          const FullDisk full(room);
          why = write_complaint(path, result);
        }
        CAPTURE(size);
        CAPTURE(ending);
        CAPTURE(room);
        CHECK(why != "");
        CHECK(bytes_of(path) == "the old image");
        CHECK(folder.entries() == files);
      }
      {
        const FullDisk just_enough(whole.size());
        write_image(path, result, {});
      }
      const bool same = bytes_of(path) == whole;
      CHECK(same);
    }
  }
  CHECK(folder.entries() == 4);
}
#endif

TEST_CASE("a write into a folder that is not there fails with a reason") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
    CAPTURE(ending);
    CHECK(write_complaint(folder / ("none/a" + ending), picture()) != "");
  }
  CHECK(folder.entries() == 0);
}
