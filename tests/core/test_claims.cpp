// Files that claim more than they hold are refused before memory is taken.

#include <doctest/doctest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/image/image_file.hpp"
#include "common/image/texture_file.hpp"
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

std::string attribute(const std::string& name, const std::string& type,
                      const std::string& value) {
  return name + '\0' + type + '\0' +
         number(static_cast<std::int64_t>(value.size())) + value;
}

/// The header of an EXR file with channels of floats and without pixels.
struct Exr {
  int width = 4, height = 4;
  int data_width = width, data_height = height;
  int compression = 3;  // zip
  std::vector<std::string> channels = {"B", "G", "R"};
  std::string more = {};  // attributes
  int flags = 0;

  std::string bytes() const {
    std::string list;
    for (const std::string& channel : channels) {
      list += channel + '\0' + number(2) + number(0) + number(1) + number(1);
    }
    list += '\0';
    const std::string origin = number(0) + number(0);
    const std::string one("\0\0\x80\x3f", 4);
    return number(20000630) + number(2 | flags) +
           attribute("channels", "chlist", list) +
           attribute("compression", "compression",
                     std::string(1, static_cast<char>(compression))) +
           attribute(
               "dataWindow", "box2i",
               origin + number(data_width - 1) + number(data_height - 1)) +
           attribute("displayWindow", "box2i",
                     origin + number(width - 1) + number(height - 1)) +
           attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
           attribute("pixelAspectRatio", "float", one) +
           attribute("screenWindowCenter", "v2f", origin) +
           attribute("screenWindowWidth", "float", one) + more + '\0' +
           std::string(10'000, '\0');
  }
};

std::string tiles(int width, int height) {
  return attribute("tiles", "tiledesc",
                   number(width) + number(height) + std::string(1, '\0'));
}

/// A PNG file up to its pixels. Of its checksums nobody gets to see one.
std::string png(int width, int height, char bits, char color) {
  return "\x89PNG\r\n\x1a\n" + number(13, true) + "IHDR" +
         number(width, true) + number(height, true) + bits + color +
         std::string(3, '\0') + number(0) + number(0) + "IEND" + number(0);
}

/// Whether the file is refused with these words, and hardly any memory.
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

TEST_CASE("a small EXR file that claims a large picture is refused") {
  const auto refused = [](const Exr& exr, const std::string& words) {
    check_refused(".exr", exr.bytes(), words);
  };
  refused({.width = 16384, .height = 16384}, "cannot hold 16384 x 16384");
  refused({.width = 16384, .height = 16384, .compression = 9},
          "cannot hold 16384 x 16384");
  refused({.width = 1000, .height = 10, .compression = 0},
          "cannot hold 1000 x 10 pixels");
  refused({.width = 40'000, .height = 40'000},
          "claims 40000 x 40000 pixels, more than");
  refused(
      {.width = 16384, .height = 16384, .data_width = 4, .data_height = 4},
      "its display window of 16384 x 16384 pixels is nearly empty");
  refused({.more = tiles(16384, 8192), .flags = 0x200},
          "its tiles of 16384 x 8192 pixels");
  refused({.more = std::string("a\0string\0", 9) + number(2'000'000'000)},
          "its attribute 'a' claims to be 2000000000 bytes");
  refused({.more = std::string("a\0string\0", 9) + number(-1)},
          "its attribute 'a' claims to be -1 bytes");
}

// The second of two parts claims too much.
TEST_CASE("each part of an EXR file is looked at") {
  const std::string small = Exr{.flags = 0x1000}.bytes();
  const std::string large =
      Exr{.width = 16384, .height = 16384}.bytes().substr(8);
  const std::size_t header = small.size() - 10'000;
  check_refused(".exr", small.substr(0, header) + large,
                "cannot hold 16384 x 16384");
}

TEST_CASE("many channels are pixels, too") {
  Exr exr{.width = 4096, .height = 4096};
  for (int i = 0; i < 1000; ++i) {
    exr.channels.push_back(std::to_string(i));
  }
  check_refused(".exr", exr.bytes(),
                "claims 4096 x 4096 pixels of 4012 bytes");
}

TEST_CASE("what is in a file of EXR's name must be EXR") {
  check_refused(".exr", png(4, 4, 8, 2), "it is not an EXR file");
}

TEST_CASE("a small PNG or JPEG that claims a large picture is refused") {
  check_refused(".png", png(16384, 16384, 8, 2), "cannot hold 16384 x 16384");
  check_refused(".png", png(16384, 16384, 1, 0), "cannot hold 16384 x 16384");
  check_refused(".png", png(300, 300, 16, 6), "cannot hold 300 x 300");
  std::string jpeg = bytes_of(PICTURES "/corners.jpg");
  const std::size_t frame = jpeg.find("\xff\xc0");
  REQUIRE(frame != std::string::npos);
  jpeg.replace(frame + 5, 4, "\x1f\x40\x1f\x40");
  check_refused(".png", jpeg, "cannot hold 8000 x 8000");
}

// Whatever the packer can do, it does here: zlib makes one byte of a thousand,
// and stb, which stands in for it, at best 13 bits of 258 bytes.
TEST_CASE("a large picture of one color is read, though its file is small") {
  const TemporaryFolder folder;
  RenderResult black;
  black.radiance = black.variance = Image(1500, 1000);
  for (const std::string ending : {".exr", ".png"}) {
    const std::string path = folder / ("a" + ending);
    write_image(path, black, {});
    CAPTURE(ending);
    const std::uintmax_t pixel_bytes = ending == ".exr" ? 6 * 4 : 3;
    CHECK(fs::file_size(path) < 1500 * 1000 * pixel_bytes / 50);
    CHECK(read_complaint(path) == "");
  }
}

// A gigabyte that takes no room on the disk.
TEST_CASE("of a file that is too long no more is read than is needed") {
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
  check_refused(ppm, "it has 1073741824 bytes, and its pixels take ");
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
