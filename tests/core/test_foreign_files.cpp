// Files that the image library would read as something else, or not survive.

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "common/image/image_file.hpp"
#include "common/image/texture_file.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace std::string_literals;

// Without a check OpenImageIO 2.4 aborts.
TEST_CASE("an EXR file whose channels are of no known type is refused") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.exr";
  write_image(path, picture(), {});
  const std::string good = bytes_of(path);
  const std::size_t list = good.find("channels\0chlist\0"s);
  REQUIRE(list != std::string::npos);
  for (const std::string channel : {"B", "R", "variance.G"}) {
    CAPTURE(channel);
    const std::size_t at =
        good.find('\0' + channel + '\0', list) + 2 + channel.size();
    std::string bytes = good;
    bytes.replace(at, 4, "\3\0\0\0"s);
    store(path, bytes);
    CHECK(read_complaint(path) ==
          "its channel '" + channel + "' is of type 3: 0, 1 and 2 are known");
  }
}

// Otherwise a file that is broken is handed to every reader there is.
TEST_CASE("a file is read as what its name or its first bytes say") {
  const TemporaryFolder folder;
  const auto copy = [&](const char* picture, const char* name) {
    std::filesystem::copy_file(std::string(PICTURES "/") + picture,
                               folder / name);
    return folder / name;
  };
  CHECK(read_complaint(copy("corners.png", "a.exr")) != "");
  CHECK(read_complaint(copy("half.exr", "a.png")) ==
        "it is neither a PNG nor a JPEG");
  copy("corners.png", "a.jpg");
  CHECK(load_texture(folder / "", "a.jpg").width == 4);
  copy("corners.jpg", "b.png");
  CHECK(load_texture(folder / "", "b.png").width == 32);
}
