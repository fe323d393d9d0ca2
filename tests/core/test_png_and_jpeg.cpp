// PNG and JPEG: the colors as stored, and complete files only.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image_file.hpp"
#include "common/image/texture_file.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace std::string_literals;

namespace {

const std::string pictures = PICTURES;

using Texel = std::array<std::uint8_t, 3>;

std::string text(const Texel& texel) {
  return std::to_string(texel[0]) + ' ' + std::to_string(texel[1]) + ' ' +
         std::to_string(texel[2]);
}

/// The message that refuses a texture; "" if it can be used.
std::string texture_complaint(const TemporaryFolder& folder,
                              const std::string& name) {
  try {
    load_texture(folder / "", name);
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

/// "red green / blue white": what is in the four corners, row by row.
std::string corners(const Texture& texture) {
  const auto name = [&](int column, int row) -> std::string {
    const Texel& t = texture.at(column, row);
    const bool red = t[0] > 200, green = t[1] > 200, blue = t[2] > 200;
    return red && green && blue ? "white"
           : red                ? "red"
           : green              ? "green"
           : blue               ? "blue"
                                : "none";
  };
  const int right = texture.width - 1, bottom = texture.height - 1;
  return name(0, 0) + ' ' + name(right, 0) + " / " + name(0, bottom) + ' ' +
         name(right, bottom);
}

}  // namespace

TEST_CASE("alpha and transparency leave a texture's colors as stored") {
  for (const char* name : {"rgba.png", "rgba_16.png", "rgb_trns.png",
                           "palette.png", "palette_trns.png"}) {
    CAPTURE(name);
    const Texture texture = load_texture(pictures, name);
    REQUIRE(texture.width == 2);
    REQUIRE(texture.height == 1);
    CHECK(text(texture.at(0, 0)) == "255 100 20");
    CHECK(text(texture.at(1, 0)) == "40 200 255");
  }
  for (const char* name : {"grey_alpha.png", "grey_trns.png"}) {
    CAPTURE(name);
    const Texture texture = load_texture(pictures, name);
    CHECK(text(texture.at(0, 0)) == "255 255 255");
    CHECK(text(texture.at(1, 0)) == "100 100 100");
  }
}

TEST_CASE("a JPEG is read, with or without data behind its end marker") {
  const TemporaryFolder folder;
  for (const char* name : {"corners.jpg", "corners_progressive.jpg"}) {
    CAPTURE(name);
    const std::string whole = bytes_of(pictures + '/' + name);
    CHECK(corners(load_texture(pictures, name)) == "red green / blue white");
    store(folder / "a.jpg", whole + std::string(1000, '\xff') + "a film");
    CHECK(corners(load_texture(folder / "", "a.jpg")) ==
          "red green / blue white");
  }
}

// With a thumbnail in its metadata, which has data and an end marker, too.
// stb 2.27 would write beyond its own table.
TEST_CASE("a JPEG that claims more than 256 Huffman codes is refused") {
  const TemporaryFolder folder;
  const std::string table = std::string("\xff\xc4\x02\x13\0", 5);
  store(folder / "a.jpg", "\xff\xd8" + table + std::string(16, '\x20') +
                              std::string(512, 'x') + "\xff\xd9");
  CHECK(texture_complaint(folder, "a.jpg")
            .find("a table of 512 Huffman codes") != std::string::npos);
}

TEST_CASE("a JPEG that ends early is refused, wherever it ends") {
  const TemporaryFolder folder;
  for (const char* name : {"/corners.jpg", "/corners_progressive.jpg"}) {
    const std::string thumbnail = "Exif\0\0\xff\xd8\xff\xda data\xff\xd9"s;
    const auto length = static_cast<char>(thumbnail.size() + 2);
    const std::string whole =
        bytes_of(pictures + name)
            .insert(2, "\xff\xe1\0"s + length + thumbnail);
    store(folder / "a.jpg", whole);
    CHECK(texture_complaint(folder, "a.jpg") == "");
    for (std::size_t size = 0; size < whole.size(); ++size) {
      store(folder / "a.jpg", whole.substr(0, size));
      CAPTURE(size);
      CHECK(texture_complaint(folder, "a.jpg") != "");
    }
    CHECK(texture_complaint(folder, "a.jpg") ==
          "it is cut off: a JPEG ends with FF D9");
  }
}

TEST_CASE(
    "what is neither PNG nor JPEG is refused, and names do not matter") {
  const TemporaryFolder folder;
  store(folder / "empty.png", "");
  store(folder / "text.jpg", "This is text, not a picture.");
  for (const char* name : {"empty.png", "text.jpg"}) {
    CHECK(texture_complaint(folder, name) ==
          "it is no PNG or JPEG that stb can read");
  }
  store(folder / "a.jpg", bytes_of(pictures + "/corners.png"));
  store(folder / "b.png", bytes_of(pictures + "/corners.jpg"));
  CHECK(load_texture(folder / "", "a.jpg").width == 4);
  CHECK(load_texture(folder / "", "b.png").width == 32);
}

TEST_CASE("other formats of textures need OpenImageIO") {
  const TemporaryFolder folder;
  store(folder / "a.gif", "GIF89a");
  CHECK(texture_complaint(folder, "a.gif") ==
        "its name ends in none of .png, .jpg, .jpeg, .tif, .tiff, .webp");
  // A TIFF of one gray pixel, 200, whose first row is at the right (6): see
  // the TIFF specification, revision 6.0, for the twelve bytes of an entry.
  const auto entry = [](int tag, int type, int value) {
    const auto low = [](int n) { return static_cast<char>(n & 255); };
    return std::string{low(tag), low(tag >> 8), low(type),       0, 1, 0, 0,
                       0,        low(value),    low(value >> 8), 0, 0};
  };
  const std::string tiff =
      "II*\0\x0a\0\0\0"s + "\xc8\x64" + "\x0a\0"s + entry(256, 3, 2) +
      entry(257, 3, 1) + entry(258, 3, 8) + entry(259, 3, 1) +
      entry(262, 3, 1) + entry(273, 4, 8) + entry(274, 3, 6) +
      entry(277, 3, 1) + entry(278, 3, 1) + entry(279, 4, 2) +
      std::string(4, '\0');
  store(folder / "a.tif", tiff);
  if (!has_exr) {
    CHECK(texture_complaint(folder, "a.tif")
              .starts_with(".tif needs OpenImageIO, "));
    return;
  }
  const Texture texture = load_texture(folder / "", "a.tif");
  REQUIRE(texture.width == 1);  // two pixels in a row, turned clockwise
  REQUIRE(texture.height == 2);
  CHECK(text(texture.at(0, 0)) == "200 200 200");
  CHECK(text(texture.at(0, 1)) == "100 100 100");
}

// Viewers decode by what the file says. Before the pixels stand chunks of
// length, name, data and a sum; gAMA has 100000 times the exponent of the
// encoding, and an sRGB chunk would overrule it.
TEST_CASE("a PNG file names the gamma of its encoding") {
  const TemporaryFolder folder;
  using enum ToneStep;
  const auto exponent = [&](const ToneMapping& mapping) {
    write_image(folder / "a.png", picture(), mapping);
    const std::string bytes = bytes_of(folder / "a.png");
    CHECK(bytes.find("sRGB") > bytes.find("IDAT"));
    const std::size_t at = bytes.find("gAMA");
    REQUIRE(at < bytes.find("IDAT"));
    int number = 0;
    for (std::size_t i = 4; i < 8; ++i) {
      number = 256 * number + static_cast<std::uint8_t>(bytes[at + i]);
    }
    return number;
  };
  CHECK(exponent({}) == 45455);  // 1 / 2.2
  CHECK(exponent({0, {clamp}, 2.2f}) == 100000);
  CHECK(exponent({0, {reinhard}, 2.2f}) == 100000);
  CHECK(exponent({0, {reinhard, gamma}, 2}) == 50000);
  CHECK(exponent({0, {clamp, gamma, gamma}, 2}) == 25000);
  CHECK(exponent({0, {}, 2.2f, 2.0f}) == 50000);
}
