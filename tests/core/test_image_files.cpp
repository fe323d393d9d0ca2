// Images in files, in all formats.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image_file.hpp"
#include "common/image/texture_file.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const std::string pictures = PICTURES "/";

/// The formats that store a complete render.
std::vector<std::string> whole_formats() {
  return has_exr ? std::vector<std::string>{".pfm", ".exr"}
                 : std::vector<std::string>{".pfm"};
}

}  // namespace

TEST_CASE("a file gives back radiance and variance to the last bit") {
  const TemporaryFolder folder;
  const RenderResult written = picture();
  for (const std::string& format : whole_formats()) {
    CAPTURE(format);
    write_image(folder / ("a" + format), written, {});
    const RenderResult read = read_image(folder / ("a" + format));
    CHECK(same_bits(read.radiance, written.radiance));
    CHECK(same_bits(read.variance, written.variance));
    CHECK(read.info.samples_per_pixel == written.info.samples_per_pixel);
    CHECK(read.info.seed == written.info.seed);
    CHECK(read.info.max_bounces == written.info.max_bounces);
    CHECK(read.info.scene_hash == written.info.scene_hash);
    CHECK(read.info.rays == written.info.rays);
    CHECK(read.info.dropped == written.info.dropped);
  }
}

TEST_CASE("a .pfm file does not name the program that rendered it") {
  RenderResult other = picture();
  other.info.stage = "stage6";
  other.info.version = "9.9.9";
  const bool same = encode_pfm(other) == encode_pfm(picture());
  CHECK(same);
}

TEST_CASE("equal renders are equal files") {
  const TemporaryFolder folder;
  for (const std::string& ending : endings()) {
    write_image(folder / ("a" + ending), picture(), {});
    write_image(folder / ("b" + ending), picture(), {});
    CAPTURE(ending);
    CHECK(bytes_of(folder / ("a" + ending)).size() > 50);
    const bool equal = bytes_of(folder / ("a" + ending)) ==
                       bytes_of(folder / ("b" + ending));
    CHECK(equal);
  }
}

TEST_CASE("a picture without variance is written without it") {
  const TemporaryFolder folder;
  RenderResult plain = picture();
  plain.variance = Image();
  for (const std::string& format : whole_formats()) {
    CHECK(write_complaint(folder / ("a" + format), plain) == "");
    const RenderResult read = read_image(folder / ("a" + format));
    CHECK(same_bits(read.radiance, plain.radiance));
    CHECK(read.variance.pixels.empty());
  }
}

TEST_CASE("a PNG file shows the tone-mapped image, to an 8-bit step") {
  const TemporaryFolder folder;
  const ToneMapping mapping{1, {ToneStep::reinhard, ToneStep::gamma}, 2.0f};
  write_image(folder / "a.png", picture(), mapping);
  const Image expected = tone_map(picture().radiance, mapping);
  const Texture read = load_texture(folder / "", "a.png");
  REQUIRE(read.width == expected.width);
  REQUIRE(read.height == expected.height);
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const auto byte =
          static_cast<float>(read.texels[i][static_cast<std::size_t>(c)]);
      CHECK(std::abs(byte - 255 * expected.pixels[i][c]) <= 0.501f);
    }
  }
}

TEST_CASE("PFM and PPM files hold linear radiance, not what is shown") {
  const TemporaryFolder folder;
  const RenderResult written = picture();
  write_image(folder / "a.pfm", written, {});
  write_image(folder / "a.ppm", written, {});
  CHECK(same_bits(read_image(folder / "a.pfm").radiance, written.radiance));
  const Image read = read_image(folder / "a.ppm").radiance;
  for (std::size_t i = 0; i < read.pixels.size(); ++i) {
    CHECK(max_abs_component(read.pixels[i] - written.radiance.pixels[i]) <=
          max_value(written.radiance) * 0.51f / 65535);
  }
}

TEST_CASE("the file extension gives the format, also in capitals") {
  const TemporaryFolder folder;
  write_image(folder / "A.PFM", picture(), {});
  CHECK(bytes_of(folder / "A.PFM").substr(0, 3) == "PF\n");
  CHECK(same_bits(read_image(folder / "A.PFM").radiance, picture().radiance));
}

TEST_CASE("a new image replaces the old one, and nothing else is left") {
  const TemporaryFolder folder;
  for (const std::string& ending : endings()) {
    const std::string path = folder / ("a" + ending);
    store(path, "the old image");
    write_image(path, picture(), {});
    CAPTURE(ending);
    CHECK(read_complaint(path) == "");
  }
  CHECK(folder.entries() == static_cast<std::ptrdiff_t>(endings().size()));
}

TEST_CASE("an EXR file without OpenImageIO is refused in one line") {
  const TemporaryFolder folder;
  if (has_exr) return;
  const std::string why =
      ".exr needs OpenImageIO, and this program was built without it; a "
      ".pfm has the same numbers";
  CHECK(write_complaint(folder / "a.exr", picture()) == why);
  CHECK(read_complaint(pictures + "half.exr") == why);
}

TEST_CASE("EXR files are read by their channels R, G, B, or refused") {
  if (!has_exr) return;
  CHECK(read_image(pictures + "half.exr").radiance.at(0, 0) == Vec3(1, 2, 3));
  CHECK(read_complaint(pictures + "grey.exr") ==
        "its channels are Y, and R, G, B are expected");
  CHECK(read_complaint(pictures + "layers.exr")
            .ends_with(", and R, G, B are expected"));
  CHECK(read_complaint(pictures + "uint.exr") ==
        "its channel R holds whole numbers, and radiance is floats");
}

// Red is 1 2 3 in row 2, and 4 5 6 in row 3.
TEST_CASE("pixels outside an EXR's display window are left out") {
  if (!has_exr) return;
  const Image crop = read_image(pictures + "crop.exr").radiance;
  REQUIRE(crop.width == 5);
  REQUIRE(crop.height == 5);
  CHECK(crop.at(1, 2).x == 1);
  CHECK(crop.at(3, 3).x == 6);
  CHECK(crop.at(0, 0) == Vec3(0));
  const Image overscan = read_image(pictures + "overscan.exr").radiance;
  REQUIRE(overscan.width == 1);
  REQUIRE(overscan.height == 2);
  CHECK(overscan.at(0, 0).x == 5);
  CHECK(overscan.at(0, 1).x == 0);
}
