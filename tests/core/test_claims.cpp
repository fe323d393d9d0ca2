// Files that claim more than they hold are refused before memory is taken.

#include <doctest/doctest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/image/image_file.hpp"
#include "common/image/texture_file.hpp"
#include "common/scene_file/toml_reader.hpp"
#include "tests/core/largest_allocation.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
namespace fs = std::filesystem;

namespace {

std::string number(std::int64_t value, bool big_endian = false) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) {
    const auto byte = static_cast<char>(value >> 8 * i & 0xff);
    bytes.insert(big_endian ? bytes.begin() : bytes.end(), byte);
  }
  return bytes;
}

/// A PNG file up to its pixels. Its checksums are never read.
std::string png(int width, int height, char bits, char color) {
  return "\x89PNG\r\n\x1a\n" + number(13, true) + "IHDR" +
         number(width, true) + number(height, true) + bits + color +
         std::string(3, '\0') + number(0) + number(0) + "IEND" + number(0);
}

/// Whether the file is refused with these words, and with hardly any memory.
void check_refused(const std::string& path, const std::string& words) {
  CAPTURE(path);
  largest_allocation = 0;
  const std::string complaint = read_complaint(path);
  CAPTURE(complaint);
  CHECK(complaint.find(words) != std::string::npos);
  CHECK(largest_allocation < 1'000'000);
}

void check_refused(const std::string& ending, const std::string& bytes,
                   const std::string& words) {
  const TemporaryFolder folder;
  store(folder / ("a" + ending), bytes);
  check_refused(folder / ("a" + ending), words);
}

}  // namespace

TEST_CASE("a small PNG or JPEG that claims a large picture is refused") {
  check_refused(".png", png(8192, 8192, 8, 2), "cannot hold 8192 x 8192");
  check_refused(".png", png(8192, 8192, 1, 0), "cannot hold 8192 x 8192");
  check_refused(".png", png(16384, 16384, 8, 2), "claims 16384 x 16384");
  std::string jpeg = bytes_of(PICTURES "/corners.jpg");
  const std::size_t frame = jpeg.find("\xff\xc0");
  REQUIRE(frame != std::string::npos);
  jpeg.replace(frame + 5, 4, "\x1f\x40\x1f\x40");
  check_refused(".png", jpeg, "cannot hold 8000 x 8000");
}

TEST_CASE("a large picture of one color is read, though its file is small") {
  const TemporaryFolder folder;
  RenderResult black;
  black.radiance = black.variance = Image(1500, 1000);
  for (const std::string& ending : endings()) {
    CAPTURE(ending);
    write_image(folder / ("a" + ending), black, {});
    CHECK(read_complaint(folder / ("a" + ending)) == "");
  }
}

// A gigabyte that takes no room on the disk.
TEST_CASE("no more of a file that is too long is read than is needed") {
  const TemporaryFolder folder;
  const auto lengthen = [&](const std::string& path) {
    fs::resize_file(path, std::uintmax_t{1} << 30);
  };
  const std::string pfm = folder / "a.pfm", ppm = folder / "a.ppm";
  write_image(pfm, picture(), {});
  lengthen(pfm);
  largest_allocation = 0;
  CHECK(same_bits(read_image(pfm).radiance, picture().radiance));
  CHECK(largest_allocation < 1'000'000);
  write_image(ppm, picture(), {});
  lengthen(ppm);
  largest_allocation = 0;
  CHECK(read_complaint(ppm) == "");
  CHECK(largest_allocation < 3'000'000);
}

TEST_CASE("a text header that claims more pixels than any picture has") {
  check_refused(".pfm", "PF 65536 65536 -1\n", "claims 65536 x 65536 pixels");
  check_refused(".ppm", "P3 65536 65536 9\n", "claims 65536 x 65536 pixels");
}

TEST_CASE("a texture's name with a NUL names no file") {
  const TemporaryFolder folder;
  fs::copy_file(PICTURES "/corners.png", folder / "a.png");
  const std::string root = fs::path(folder / "").string();
  CHECK_NOTHROW(load_texture(root, "a.png"));
  CHECK_THROWS_WITH_AS(load_texture(root, std::string("a.png\0.png", 10)),
                       "its name has a NUL character", FileError);
}

TEST_CASE("a scene file of too many values is refused before it is read") {
  const auto complaint = [](std::string_view text) -> std::string {
    try {
      check_extent(text, "a.toml", 8);
      return "";
    } catch (const SceneError& error) {
      return error.what();
    }
  };
  CHECK(complaint("a = [1, 2, {b = 3}]\n") == "");
  CHECK(complaint("a = '[[[[[[[[[[[[[[' # =======\n") == "");
  CHECK(complaint("a = [1, 2, {b = 3, c = 4}]\n[d]\n") ==
        "a.toml:2:1: the file has more than 8 values");
}
