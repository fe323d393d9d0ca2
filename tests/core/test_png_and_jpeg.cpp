// PNG and JPEG: colors as they are stored, upright, and whole.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image_file.hpp"
#include "common/image/orientation.hpp"
#include "common/image/picture_file.hpp"
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

/// A texture's complaint; "" if it can be used.
std::string texture_complaint(const TemporaryFolder& folder,
                              const std::string& name) {
  try {
    load_texture(folder / "", name);
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

std::string big_endian(std::size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> shift & 255);
  }
  return bytes;
}

/// A small TIFF file with an orientation alone, in either byte order.
std::string exif(int orientation, bool is_big) {
  const char value = static_cast<char>(orientation);
  if (is_big) {
    return std::string("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0",
                       19) +
           value + std::string(6, '\0');
  }
  return std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18) +
         value + std::string(7, '\0');
}

/// A JPEG with an APP1 segment behind its first marker.
std::string turned_jpeg(std::string jpeg, const std::string& data) {
  const std::string body = std::string("Exif\0\0", 6) + data;
  const std::size_t length = body.size() + 2;
  const std::string segment =
      "\xff\xe1" + big_endian(length).substr(2) + body;
  return jpeg.insert(2, segment);
}

/// A chunk of a PNG: its length, its name, its data, and the sum over both.
std::string png_chunk(const std::string& name, const std::string& data) {
  const std::string chunk = name + data;
  std::uint32_t crc = 0xffffffff;
  for (const char c : chunk) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return big_endian(data.size()) + chunk + big_endian(~crc);
}

/// A PNG with an eXIf chunk behind its header.
std::string turned_png(std::string png, const std::string& data) {
  return png.insert(33, png_chunk("eXIf", data));
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

TEST_CASE("alpha leaves the values of a PNG that is read as an image") {
  for (const char* name :
       {"/rgba.png", "/rgb_trns.png", "/rgba_16.png", "/palette_trns.png"}) {
    CAPTURE(name);
    const Image image = read_image(pictures + name).radiance;
    CHECK(max_abs_component(image.at(0, 0) * 255.0f - Vec3(255, 100, 20)) <
          1e-3f);
    CHECK(max_abs_component(image.at(1, 0) * 255.0f - Vec3(40, 200, 255)) <
          1e-3f);
  }
}

TEST_CASE("a JPEG is read, with what is behind its end marker or without") {
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

TEST_CASE("a JPEG that ends early is refused, wherever it ends") {
  const TemporaryFolder folder;
  for (const char* name : {"/corners.jpg", "/corners_progressive.jpg"}) {
    // With a thumbnail in its metadata, which has an end marker too.
    const std::string whole = turned_jpeg(bytes_of(pictures + name),
                                          exif(1, true) + "\xff\xd8\xff\xd9");
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const std::string error = inspect_picture(whole.substr(0, size)).error;
      CAPTURE(size);
      CHECK(error != "");
    }
    CHECK(inspect_picture(whole).error == "");
    store(folder / "cut.jpg", whole.substr(0, whole.size() - 20));
    CHECK(texture_complaint(folder, "cut.jpg") ==
          "it is cut off: a JPEG ends with the bytes FF D9, and there are "
          "none in its " +
              std::to_string(whole.size() - 20) + " bytes");
  }
}

TEST_CASE("a PNG with a chunk whose name is none is refused with a reason") {
  const TemporaryFolder folder;
  const std::string png = bytes_of(pictures + "/corners.png");
  for (const std::string name : {std::string(4, '\0'), "I\0AT"s, "1234"s}) {
    store(folder / "a.png",
          std::string(png).insert(33, png_chunk(name, "data")));
    const std::string why = texture_complaint(folder, "a.png");
    CAPTURE(why);
    CHECK(why != "");
    CHECK_FALSE(why.ends_with(": "));
  }
}

TEST_CASE("what is neither PNG nor JPEG is refused, whatever its name") {
  const TemporaryFolder folder;
  store(folder / "empty.png", "");
  store(folder / "text.jpg", "This is text, not a picture.");
  write_image(folder / "a.exr", picture(), {});
  store(folder / "renamed.png", bytes_of(folder / "a.exr"));
  CHECK(texture_complaint(folder, "empty.png") == "it is empty");
  for (const char* name : {"text.jpg", "renamed.png"}) {
    CHECK(texture_complaint(folder, name) ==
          "it is neither a PNG nor a JPEG");
  }
}

// EXIF says which edge of the upright picture the stored first row is, and
// which one the first column. Stored is red green above blue white.
TEST_CASE("EXIF's orientation turns a texture, all eight of them") {
  const TemporaryFolder folder;
  const char* expected[] = {
      "red green / blue white",  // 1: top, left
      "green red / white blue",  // 2: top, right
      "white blue / green red",  // 3: bottom, right
      "blue white / red green",  // 4: bottom, left
      "red blue / green white",  // 5: left, top
      "blue red / white green",  // 6: right, top
      "white green / blue red",  // 7: right, bottom
      "green white / red blue",  // 8: left, bottom
  };
  const std::string jpeg = bytes_of(pictures + "/corners.jpg");
  const std::string png = bytes_of(pictures + "/corners.png");
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool is_big : {false, true}) {
      const std::string data = exif(orientation, is_big);
      CAPTURE(orientation);
      CAPTURE(is_big);
      store(folder / "a.jpg", turned_jpeg(jpeg, data));
      store(folder / "a.png", turned_png(png, data));
      for (const char* name : {"a.jpg", "a.png"}) {
        const Texture texture = load_texture(folder / "", name);
        CHECK(corners(texture) == expected[orientation - 1]);
        CHECK((texture.width > texture.height) == (orientation <= 4));
      }
      const Image image = read_image(folder / "a.png").radiance;
      CHECK((image.width > image.height) == (orientation <= 4));
    }
  }
}

TEST_CASE("EXIF data that are broken turn nothing") {
  const std::string good = exif(6, true);
  CHECK(exif_orientation(good) == 6);
  for (std::size_t size = 0; size < 20; ++size) {
    CHECK(exif_orientation(good.substr(0, size)) == 1);
  }
  CHECK(exif_orientation(exif(0, false)) == 1);
  CHECK(exif_orientation(exif(9, false)) == 1);
  std::string far = good;
  far.replace(4, 4, "\xff\xff\xff\xff");
  CHECK(exif_orientation(far) == 1);
}

// Viewers decode by what the file says. Before the pixels stand chunks of
// length, name, data and a sum; gAMA has 100000 times the exponent of the
// encoding, and an sRGB chunk would overrule it.
TEST_CASE("a PNG file says by which gamma it is encoded") {
  const TemporaryFolder folder;
  using enum ToneStep;
  const auto exponent = [&](const ToneMapping& mapping) {
    write_image(folder / "a.png", picture(), mapping);
    const std::string bytes = bytes_of(folder / "a.png");
    CHECK(bytes.find("sRGB") > bytes.find("IDAT"));
    const std::size_t at = bytes.find("gAMA");
    REQUIRE(at < bytes.find("IDAT"));
    return number_at(bytes, at + 4, 4, true);
  };
  CHECK(exponent({}) == 45455);  // 1 / 2.2
  CHECK(exponent({0, {clamp}, 2.2f}) == 100000);
  CHECK(exponent({0, {reinhard}, 2.2f}) == 100000);
  CHECK(exponent({0, {reinhard, gamma}, 2}) == 50000);
  CHECK(exponent({0, {clamp, gamma, gamma}, 2}) == 25000);
  CHECK(exponent({0, {}, 2.2f, 2.0f}) == 50000);
}
