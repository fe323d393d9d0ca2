#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "common/image/image_file.hpp"
#include "common/math/random.hpp"

namespace lightwalk::tests {

/// A small picture with light beyond 1, and all its information.
inline RenderResult picture(int width = 7, int height = 5) {
  RenderResult result;
  result.radiance = Image(width, height);
  result.variance = Image(width, height);
  Random random(1, 0, 0);
  for (Vec3& pixel : result.radiance.pixels) {
    pixel = {random.uniform(), 10 * random.uniform(), 1e-4f};
  }
  for (Vec3& pixel : result.variance.pixels) {
    pixel = {random.uniform(), 0, 1e6f * random.uniform()};
  }
  result.info.stage = "stage3";
  result.info.samples_per_pixel = 4096;
  result.info.seed = 18446744073709551615u;
  result.info.max_bounces = 8;
  result.info.scene_hash = std::string(64, 'a');
  result.info.rays = 9007199254740993u;  // 2^53 + 1: no double holds it
  result.info.dropped = 12345678901u;
  result.info.version = "1.2.3";
  return result;
}

inline bool same_bits(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return false;
  // An image without pixels may have no memory to compare.
  return a.pixels.empty() || std::memcmp(a.pixels.data(), b.pixels.data(),
                                         a.pixels.size() * sizeof(Vec3)) == 0;
}

/// The message if an image cannot be read; "" if it can.
inline std::string read_complaint(const std::string& path) {
  try {
    if (ending(path) == ".png") {
      read_png_or_jpeg(path);
    } else {
      read_image(path);
    }
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

/// The message of a failed write; "" if it succeeded.
inline std::string write_complaint(const std::string& path,
                                   const RenderResult& result) {
  try {
    write_image(path, result, {});
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

/// Whether EXR files can be written and read.
inline constexpr bool has_exr =
    !std::string_view(LIGHTWALK_IMAGE_MODULE).empty();

/// The formats that this build writes.
inline std::vector<std::string> endings() {
  std::vector<std::string> all = {".png", ".pfm", ".ppm"};
  if (has_exr) all.push_back(".exr");
  return all;
}

}  // namespace lightwalk::tests
