// Images in files, above all those of the image library: EXR and PNG.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image_file.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_CASE("an EXR file gives back radiance and variance to the last bit") {
  const TemporaryFolder folder;
  const RenderResult written = picture();
  write_image(folder / "a.exr", written, {});
  const RenderResult read = read_image(folder / "a.exr");
  CHECK(same_bits(read.radiance, written.radiance));
  CHECK(same_bits(read.variance, written.variance));
}

TEST_CASE("an EXR file gives back all that is said about the picture") {
  const TemporaryFolder folder;
  const RenderInfo written = picture().info;
  write_image(folder / "a.exr", picture(), {});
  const RenderInfo read = read_image(folder / "a.exr").info;
  CHECK(read.stage == written.stage);
  CHECK(read.samples_per_pixel == written.samples_per_pixel);
  CHECK(read.seed == written.seed);
  CHECK(read.max_bounces == written.max_bounces);
  CHECK(read.scene_hash == written.scene_hash);
  CHECK(read.rays == written.rays);
  CHECK(read.dropped == written.dropped);
  CHECK(read.version == written.version);
}

TEST_CASE("equal renders are equal files") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
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
  CHECK(write_complaint(folder / "a.exr", plain) == "");
  const RenderResult read = read_image(folder / "a.exr");
  CHECK(same_bits(read.radiance, plain.radiance));
  CHECK(read.variance.pixels.empty());
  CHECK(read.info.seed == plain.info.seed);
}

TEST_CASE("a PNG file shows the tone-mapped image, to an 8-bit step") {
  const TemporaryFolder folder;
  const ToneMapping mapping{1, {ToneStep::reinhard, ToneStep::gamma}, 2.0f};
  write_image(folder / "a.png", picture(), mapping);
  const Image expected = tone_map(picture().radiance, mapping);
  const Image read = read_image(folder / "a.png").radiance;
  REQUIRE(read.width == expected.width);
  REQUIRE(read.height == expected.height);
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    INFO(text(read.pixels[i]) << " for " << text(expected.pixels[i]));
    CHECK(max_abs_component(read.pixels[i] - expected.pixels[i]) <=
          0.501f / 255);
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

TEST_CASE("the ending tells the format in capitals too") {
  const TemporaryFolder folder;
  write_image(folder / "A.PFM", picture(), {});
  CHECK(bytes_of(folder / "A.PFM").substr(0, 3) == "PF\n");
  CHECK(same_bits(read_image(folder / "A.PFM").radiance, picture().radiance));
}

TEST_CASE("a new image replaces the old one, and nothing else is left") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
    const std::string path = folder / ("a" + ending);
    store(path, "the old image");
    write_image(path, picture(), {});
    CAPTURE(ending);
    CHECK(read_complaint(path) == "");
  }
  CHECK(folder.entries() == 4);
}
