// OpenImageIO beside the small libraries that stand in for it: what one
// writes the other reads, and both read the same from one file.

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/image/image_file.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
namespace fs = std::filesystem;

namespace {

const ImageCodecs& loaded(const char* file) {
  std::string error;
  GetImageCodecs* const get = load_image_codecs(file, error);
  const bool found = get != nullptr;
  REQUIRE_MESSAGE(found, error);
  return *get();
}
const ImageCodecs& large() {
  return loaded(LARGE_LIBRARY);
}
const ImageCodecs& small() {
  return loaded(SMALL_LIBRARY);
}

/// All files below a folder that end so, in an order of their own.
std::vector<std::string> files(const std::string& folder,
                               const std::string& ending) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ending) {
      found.push_back(entry.path().string());
    }
  }
  return found;
}

void check_same_info(const RenderInfo& a, const RenderInfo& b) {
  CHECK(a.stage == b.stage);
  CHECK(a.samples_per_pixel == b.samples_per_pixel);
  CHECK(a.seed == b.seed);
  CHECK(a.max_bounces == b.max_bounces);
  CHECK(a.scene_hash == b.scene_hash);
  CHECK(a.rays == b.rays);
  CHECK(a.dropped == b.dropped);
  CHECK(a.version == b.version);
}

/// Both refuse a file, or both read the same.
void check_read_alike(const std::string& path) {
  CAPTURE(path);
  RenderResult a, b;
  const std::string why_large = large().read_exr(path, a);
  const std::string why_small = small().read_exr(path, b);
  INFO("OpenImageIO: " << why_large << "; small: " << why_small);
  REQUIRE(why_large.empty() == why_small.empty());
  if (!why_large.empty()) return;
  CHECK(same_bits(a.radiance, b.radiance));
  CHECK(same_bits(a.variance, b.variance));
  CHECK(a.note == b.note);
  check_same_info(a.info, b.info);
}

/// The picture that a library makes of a file; fails where it refuses it.
Image png(const ImageCodecs& library, const std::string& path) {
  Image image;
  REQUIRE(library.read_png(path, image) == "");
  return image;
}

double largest_difference(const Image& a, const Image& b) {
  REQUIRE(a.width == b.width);
  REQUIRE(a.height == b.height);
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      largest =
          std::max(largest, std::abs(static_cast<double>(a.pixels[i][c]) -
                                     static_cast<double>(b.pixels[i][c])));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("golden EXR files are the same numbers to both libraries") {
  const std::vector<std::string> goldens = files(GOLDENS, ".exr");
  REQUIRE(goldens.size() > 10);
  for (const std::string& path : goldens) check_read_alike(path);
}

TEST_CASE("EXR files of other programs are the same to both libraries") {
  const std::vector<std::string> pictures = files(PICTURES, ".exr");
  REQUIRE(pictures.size() > 5);
  for (const std::string& path : pictures) check_read_alike(path);
}

TEST_CASE("an EXR file that either library wrote is read by both") {
  const TemporaryFolder folder;
  for (const int size : {1, 7, 16, 17, 40}) {
    RenderResult written = picture(size, size + 1);
    if (size == 16) written.variance = Image();
    if (size == 17) written.info = {};  // texts that are empty
    for (const ImageCodecs* library : {&large(), &small()}) {
      std::string bytes;
      REQUIRE(library->encode_exr(written, bytes) == "");
      store(folder / "a.exr", bytes);
      check_read_alike(folder / "a.exr");
      RenderResult read;
      REQUIRE(small().read_exr(folder / "a.exr", read) == "");
      CHECK(same_bits(read.radiance, written.radiance));
      CHECK(same_bits(read.variance, written.variance));
      check_same_info(read.info, written.info);
    }
  }
}

// Each step of 8 bits, and values between two steps on either side of the
// middle, where one library may round up and the other down.
TEST_CASE("a PNG file that either library wrote has the same pixels") {
  const TemporaryFolder folder;
  Image image(256, 6);
  for (int column = 0; column < 256; ++column) {
    for (int row = 0; row < 6; ++row) {
      const float step =
          static_cast<float>(column) + 0.09f * static_cast<float>(row);
      image.at(column, row) = {step / 255, 1 - step / 256, 0.5f};
      for (int c = 0; c < 3; ++c) {
        float& value = image.at(column, row)[c];
        value = std::min(std::max(value, 0.0f), 1.0f);
      }
    }
  }
  std::string bytes;
  REQUIRE(large().encode_png(image, 2.2f, bytes) == "");
  store(folder / "large.png", bytes);
  REQUIRE(small().encode_png(image, 2.2f, bytes) == "");
  store(folder / "small.png", bytes);
  const Image expected = png(large(), folder / "large.png");
  // To rounding: one divides by 255, the other multiplies by its inverse.
  CHECK(largest_difference(expected, png(large(), folder / "small.png")) ==
        0);
  CHECK(largest_difference(expected, png(small(), folder / "large.png")) <
        1e-6);
  CHECK(largest_difference(expected, png(small(), folder / "small.png")) <
        1e-6);
}

TEST_CASE("PNG files of other programs are the same to both libraries") {
  const std::vector<std::string> pictures = files(PICTURES, ".png");
  REQUIRE(pictures.size() > 5);
  for (const std::string& path : pictures) {
    CAPTURE(path);
    CHECK(largest_difference(png(large(), path), png(small(), path)) < 1e-6);
    Texture a, b;
    REQUIRE(large().read_texture(path, a) == "");
    REQUIRE(small().read_texture(path, b) == "");
    CHECK(a.width == b.width);
    const bool same_texels = a.texels == b.texels;
    CHECK(same_texels);
  }
}
