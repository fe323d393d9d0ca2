// EXR files of this program, of its older versions, and of other programs.

#include <doctest/doctest.h>

#include <string>

#include "common/image/exr_layers.hpp"
#include "common/image/image_file.hpp"
#include "tests/core/picture.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

RenderResult read(const std::string& name) {
  return read_image(std::string(PICTURES "/") + name);
}

std::string complaint(const std::string& name) {
  return read_complaint(std::string(PICTURES "/") + name);
}

/// The layer that is taken, its part, and the note or the error.
std::string choice(const std::vector<ExrPart>& parts) {
  const ExrChoice chosen = choose_picture(parts);
  if (!chosen.error.empty()) return chosen.error;
  return chosen.picture.name + " in " + std::to_string(chosen.picture.part) +
         ": " + chosen.note;
}

/// The channels R, G, B of some layers, one after the other.
std::vector<std::string> rgb(const std::vector<std::string>& layers) {
  std::vector<std::string> channels;
  for (const std::string& layer : layers) {
    for (const char* name : {"R", "G", "B"}) {
      channels.push_back(layer.empty() ? name : layer + '.' + name);
    }
  }
  return channels;
}

}  // namespace

// In the header, channels stand by name, after their list's size; a part of
// several would have a name, and the file a flag for it in its version.
TEST_CASE("an EXR file is one part, R, G, B and the layer variance") {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", picture(), {});
  const std::string bytes = bytes_of(folder / "a.exr");
  CHECK(bytes.substr(0, 8) == std::string("\x76\x2f\x31\x01\x02\0\0\0", 8));
  std::size_t at = bytes.find("chlist");
  for (const std::string name :
       {"B", "G", "R", "variance.B", "variance.G", "variance.R"}) {
    CAPTURE(name);
    at = bytes.find(name + '\0', at + 1);
    REQUIRE(at != std::string::npos);
  }
}

TEST_CASE("files with the parts radiance and variance are read") {
  const RenderResult read =
      read_image(GOLDENS "/stage1/cornell_box_ceiling_diffuse.exr");
  CHECK(read.note == "");
  CHECK(read.info.samples_per_pixel > 1);
  REQUIRE(read.variance.width == read.radiance.width);
  CHECK(max_value(read.radiance) > 0);
  CHECK(max_value(read.variance) > 0);
  CHECK_FALSE(same_bits(read.radiance, read.variance));
}

TEST_CASE("layers of other programs: the picture, never the albedo") {
  struct Case {
    const char *name, *note;
  };
  for (const Case& one :
       {Case{"half.exr", ""}, Case{"default_and_layers.exr", ""},
        Case{"layers.exr",
             "takes ViewLayer.Combined of ViewLayer.Albedo, "
             "ViewLayer.Combined"},
        Case{"two_parts.exr", "takes beauty of albedo, beauty"},
        Case{"only_layer.exr",
             "takes diffuse, its only layer with colors"}}) {
    CAPTURE(one.name);
    const RenderResult result = read(one.name);
    CHECK(result.radiance.at(1, 1) == Vec3(1, 2, 3));
    CHECK(result.variance.pixels.empty());
    CHECK(result.note == one.note);
  }
  CHECK(read("grey.exr").radiance.at(1, 1) == Vec3(2));
}

TEST_CASE("EXR files without a picture are refused with what they have") {
  CHECK(complaint("normals.exr") ==
        "it has no colors: its channels are N.X, N.Y, N.Z, and R, G, B or Y "
        "are expected");
  CHECK(complaint("unknown_layers.exr") ==
        "none of its layers diffuse, normal is called like a picture "
        "(Combined, beauty, rgba)");
}

// Red is 1 to 6 in three columns from 1 on and two rows from 2 on.
TEST_CASE("pixels lie in the display window, with black around them") {
  const Image crop = read("crop.exr").radiance;
  REQUIRE(crop.width == 5);
  REQUIRE(crop.height == 5);
  CHECK(crop.at(1, 2) == Vec3(1, 10, 100));
  CHECK(crop.at(3, 3) == Vec3(6, 60, 600));
  for (const auto& [x, y] : {std::pair(0, 2), {4, 3}, {1, 1}, {3, 4}}) {
    CHECK(crop.at(x, y) == Vec3(0));
  }
  const Image overscan = read("overscan.exr").radiance;
  REQUIRE(overscan.width == 1);
  REQUIRE(overscan.height == 2);
  CHECK(overscan.at(0, 0) == Vec3(5, 50, 500));
  CHECK(overscan.at(0, 1) == Vec3(0));
  CHECK(complaint("outside.exr") ==
        "none of its pixels is inside its display window");
}

TEST_CASE("which layer is taken, by their names") {
  CHECK(choice({{"", rgb({""})}}) == " in 0: ");
  CHECK(choice({{"", rgb({"variance", ""})}}) == " in 0: ");
  CHECK(choice({{"radiance", rgb({""})}, {"variance", rgb({""})}}) ==
        "radiance in 0: ");
  CHECK(choice({{"normals", rgb({""})}, {"RGBA", rgb({""})}}) ==
        "RGBA in 1: takes RGBA of normals, RGBA");
  CHECK(choice({{"Depth", {"Z"}}, {"a.Combined", rgb({"a.Combined"})}}) ==
        "a.Combined in 1: takes a.Combined, its only layer with colors");
  CHECK(choice({{"", {"diffuse.Y", "beauty.R", "beauty.G", "beauty.B"}}}) ==
        "beauty in 0: takes beauty of beauty, diffuse");
  CHECK(choice({{"left", rgb({""})}, {"right", rgb({""})}}) ==
        "none of its layers left, right is called like a picture (Combined, "
        "beauty, rgba)");
  // Luminance and color apart, a depth, and nothing but a variance.
  for (const std::vector<std::string>& channels :
       {std::vector<std::string>{"Y", "RY", "BY"},
        {"Z"},
        {"A"},
        {"R", "G"},
        {"X", "Y", "Z"},
        rgb({"variance"})}) {
    CHECK(choice({{"", channels}}).find("it has no colors: its channels") ==
          0);
  }
}
