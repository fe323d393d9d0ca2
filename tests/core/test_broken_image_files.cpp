// Broken image files.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image_file.hpp"
#include "tests/core/largest_allocation.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
namespace fs = std::filesystem;

TEST_CASE("files that are empty, cut off or text are refused with a reason") {
  const TemporaryFolder folder;
  for (const std::string& ending : endings()) {
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
        "its name ends in none of .exr, .pfm, .ppm, .hdr, .tif, .tiff");
}

// The windows, made 16384 pixels wide and high: the largest size that is read
// if the file is large enough.
TEST_CASE("an EXR header that claims too much is refused, not allocated") {
  if (!has_exr) return;
  const TemporaryFolder folder;
  const std::string path = folder / "a.exr";
  write_image(path, picture(), {});
  std::string bytes = bytes_of(path);
  for (const std::string name : {"dataWindow", "displayWindow"}) {
    const std::size_t at = bytes.find(name + '\0' + "box2i");
    REQUIRE(at != std::string::npos);
    const std::size_t corner = at + name.size() + 1 + 6 + 4 + 8;
    bytes.replace(corner, 8, std::string("\xff\x3f\0\0\xff\x3f\0\0", 8));
  }
  store(path, bytes);
  largest_allocation = 0;
  CHECK(read_complaint(path) != "");
  CHECK(largest_allocation < 100'000'000);
}
